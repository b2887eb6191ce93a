// SPDX-License-Identifier: Apache-2.0
// Which of libav's video encoders a film gets, and how it is set.
#pragma once

#include "film/film_settings.h"
#include "film/libav.h"

namespace ifa {

/// The first of the settings' encoders that there is, that takes 4:2:0 pictures, fits into MP4 and
/// opens. Errors: kInternal when there is none, with what to install.
[[nodiscard]] Result<LibavPtr<AVCodecContext>> openVideoEncoder(const FilmSettings& settings,
                                                                FrameRate rate);

/// What the user should know of an encoder that is not one of H.264; empty otherwise.
[[nodiscard]] std::string encoderWarning(const AVCodecContext& encoder);

}  // namespace ifa

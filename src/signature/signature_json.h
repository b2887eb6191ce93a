// SPDX-License-Identifier: Apache-2.0
// Signature files (docs/file-formats.md): {"format": "inverse-foley-signature", "version": 1, ...}.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "ifa/contact_signature.h"
#include "ifa/result.h"

namespace ifa {

/// Reads a signature. The first event is moved to time 0 (the shift is added to `firstContact`,
/// which the optional field `first_contact` gives) and amplitudes are divided by the first one's.
/// @param place  named in errors together with the field
/// Errors: kBadInput for text that is no JSON, another format or version, a missing or absurd
/// number, events out of order or overlapping, none at all, more than 10,000.
[[nodiscard]] Result<ContactSignature> parseSignature(std::string_view json,
                                                      const std::string& place);
[[nodiscard]] Result<ContactSignature> readSignature(const std::filesystem::path& path);

/// All digits are kept: parseSignature gives back the same signature.
[[nodiscard]] std::string formatSignature(const ContactSignature& signature);
[[nodiscard]] Result<void> writeSignature(const std::filesystem::path& path,
                                          const ContactSignature& signature);

}  // namespace ifa

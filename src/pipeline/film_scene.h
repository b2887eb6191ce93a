// SPDX-License-Identifier: Apache-2.0
// What a film shows: motions, one beside the other or on one floor, and the strip of their sound.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "body/body.h"
#include "ifa/film.h"
#include "ifa/motion.h"
#include "render/frame_renderer.h"
#include "render/overlay.h"
#include "sound/sound.h"

namespace ifa {

/// A motion to be shown. What it refers to must outlive the scene.
struct FilmPart {
  const Motion* motion = nullptr;
  const Body* body = nullptr;
  std::string name;  ///< written on its picture when there are several
  /// s of the film's sound at its first contact; none: with the first part's.
  std::optional<double> start = std::nullopt;
};

/// The contacts that a film marks: the first part's, or those of all parts where each has a start
/// of its own. Without a trajectory.
[[nodiscard]] Motion markedContacts(const std::vector<FilmPart>& parts);

/// Pictures of a film by number. Thread safe.
class FilmScene {
 public:
  /// @param parts    at least one, each with samples
  /// @param sound    the first one's, or none
  /// @param options  checked, with a size
  FilmScene(const std::vector<FilmPart>& parts, const Sound* sound, const FilmOptions& options);

  /// Pictures of the whole film: to two seconds after the last motion, or the sound's end if that
  /// comes first, and half a second of rest at least.
  [[nodiscard]] std::size_t frames() const { return frames_; }
  /// Time of the sound at picture `frame`, s.
  [[nodiscard]] double timeOf(std::size_t frame) const;
  /// The picture at a time of the sound, without the strip.
  [[nodiscard]] Image picture(double time) const;
  /// True when the pictures without the strip are surely the same.
  [[nodiscard]] bool sameAt(double time, double other) const;
  /// Adds the strip, where the options ask for it.
  void finish(Image& picture, double time) const;

 private:
  void nameViews(Image& whole) const;

  struct View {
    std::unique_ptr<render::FrameRenderer> renderer;
    int left = 0;
    std::string name;
  };

  FilmOptions options_;
  std::vector<View> views_;
  std::optional<render::Overlay> overlay_;
  std::size_t frames_ = 1;
};

/// Errors: kUsage, naming the option.
[[nodiscard]] Result<void> checkFilmOptions(const FilmOptions& options);

/// The options with the size that stands for 0.
[[nodiscard]] FilmOptions withSize(FilmOptions options);

}  // namespace ifa

// SPDX-License-Identifier: Apache-2.0
#include "pipeline/write_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "base/parallel.h"
#include "base/staged_folder.h"
#include "film/film_writer.h"
#include "render/canvas.h"
#include "render/contact_sheet.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

// Pictures that are made and not yet written; two cores need a few to stay busy.
constexpr std::size_t kAhead = 8;

const Error kStopped{ErrorCode::kInterrupted, "interrupted; nothing was written", {}, {}};

Result<void> checkParts(const std::vector<FilmPart>& parts) {
  for (const FilmPart& part : parts) {
    if (part.motion->trajectory.empty()) {
      return badInput("has no samples, so there is nothing to show", part.name);
    }
  }
  return {};
}

Result<void> check(const std::vector<FilmPart>& parts, const FilmOptions& options) {
  if (auto good = checkFilmOptions(options); !good) return good;
  return checkParts(parts);
}

/// Told before the work, not after it.
Result<void> checkWritable(const fs::path& path) {
  const auto staged = StagedFolder::open(path.has_parent_path() ? path.parent_path() : ".");
  if (staged) return {};
  Error error = staged.error();
  error.place = path.string();
  return tl::unexpected(error);
}

/// Hands the pictures to `take` in order. Those of a body at rest are drawn once.
Result<void> forEachFrame(const FilmScene& scene, const Progress& progress,
                          const std::function<Result<void>(std::size_t, const Image&)>& take) {
  std::vector<Image> made(kAhead);
  Image last;
  Result<void> outcome;
  const auto make = [&](std::size_t frame) {
    Image& place = made[frame % kAhead];
    const double time = scene.timeOf(frame);
    const bool same = frame > 0 && scene.sameAt(time, scene.timeOf(frame - 1));
    place = same ? Image() : scene.picture(time);
  };
  makeInOrder(scene.frames(), kAhead, make, [&](std::size_t frame) {
    if (made[frame % kAhead].width > 0) last = std::move(made[frame % kAhead]);
    Image finished = last;
    scene.finish(finished, scene.timeOf(frame));
    outcome = take(frame, finished);
    if (outcome && progress.stopRequested()) outcome = tl::unexpected(kStopped);
    progress("film", static_cast<double>(frame + 1) / static_cast<double>(scene.frames()));
    return outcome.has_value();
  });
  return outcome;
}

/// Frames of an earlier run, which a shorter film would leave behind.
std::vector<fs::path> oldFrames(const fs::path& folder) {
  std::vector<fs::path> old = {"sound.wav"};
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("frame-", 0) == 0 && entry.path().extension() == ".png") old.emplace_back(name);
  }
  return old;
}

std::string captionOf(std::size_t index, const Motion& motion) {
  const MotionContact& contact = motion.contacts[index];
  const double start = contact.time + motion.sound.firstContact;
  std::string text = fmt::format("{}: {:.3f} s", index + 1, start);
  if (contact.duration > 0) text += fmt::format(" to {:.3f} s", contact.end - contact.time + start);
  return text;
}

}  // namespace

Result<std::string> writeFilm(const fs::path& path, const std::vector<FilmPart>& parts,
                              const Sound* sound, const FilmOptions& wanted,
                              const Progress& progress) {
  const FilmOptions options = withSize(wanted);
  if (auto good = check(parts, options); !good) return tl::unexpected(good.error());
  FilmSettings settings;
  settings.width = options.width;
  settings.height = options.height;
  settings.framesPerSecond = options.framesPerSecond;
  settings.quality = options.final ? 17 : 21;
  settings.speed = options.speed;
  auto film = FilmWriter::open(path, settings, options.mute ? nullptr : sound);
  if (!film) return tl::unexpected(film.error());
  const FilmScene scene(parts, sound, options);
  auto written = forEachFrame(
      scene, progress, [&](std::size_t, const Image& picture) { return film->add(picture); });
  if (written) written = film->finish();
  if (!written) return tl::unexpected(written.error());
  return film->warning();
}

Result<void> writeSequence(const fs::path& folder, const std::vector<FilmPart>& parts,
                           const Sound* sound, const FilmOptions& wanted,
                           const Progress& progress) {
  const FilmOptions options = withSize(wanted);
  if (auto good = check(parts, options); !good) return good;
  auto staged = StagedFolder::open(folder);
  if (!staged) return tl::unexpected(staged.error());
  const FilmScene scene(parts, sound, options);
  auto written = forEachFrame(scene, progress, [&](std::size_t frame, const Image& picture) {
    return render::writePng(staged->path() / fmt::format("frame-{:05}.png", frame + 1), picture);
  });
  if (written && sound != nullptr && !options.mute) {
    written = writeWav(staged->path() / "sound.wav", *sound);
  }
  if (!written) return written;
  return staged->commit("sound.wav", oldFrames(folder));
}

Result<void> writeContactSheet(const fs::path& path, const std::vector<FilmPart>& parts,
                               const FilmOptions& wanted, const Progress& progress) {
  FilmOptions options = wanted;
  if (options.width == 0) options.width = 320, options.height = 180;
  if (!options.camera) options.camera = CameraKind::kCloseUp;
  options.overlay = false;
  if (auto good = check(parts, options); !good) return good;
  if (auto good = checkWritable(path); !good) return good;
  const Motion motion = markedContacts(parts);
  const std::size_t contacts = motion.contacts.size();
  if (contacts == 0) return badInput("has no contacts to show", parts.front().name);
  const FilmScene scene(parts, nullptr, options);
  std::vector<render::SheetEntry> entries(std::min(contacts, kMostSheetPictures));
  std::size_t done = 0;
  Result<void> outcome;
  makeInOrder(
      entries.size(), kAhead,
      [&](std::size_t i) {
        const std::size_t index = i * contacts / entries.size();
        const double time = motion.contacts[index].time + motion.sound.firstContact;
        entries[i] = {scene.picture(time), captionOf(index, motion)};
      },
      [&](std::size_t) {
        progress("sheet", static_cast<double>(++done) / static_cast<double>(entries.size()));
        if (progress.stopRequested()) outcome = tl::unexpected(kStopped);
        return outcome.has_value();
      });
  if (!outcome) return outcome;
  const std::string title = fmt::format("{} on {}, {} contacts, score {:.2f}", motion.object.name,
                                        motion.object.surface, contacts, motion.score);
  return render::writePng(path, render::contactSheet(entries, title));
}

Result<void> writeStill(const fs::path& path, const std::vector<FilmPart>& parts,
                        const Sound* sound, const FilmOptions& wanted, double time,
                        const Progress& progress) {
  const FilmOptions options = withSize(wanted);
  if (auto good = check(parts, options); !good) return good;
  if (auto good = checkWritable(path); !good) return good;
  const FilmScene scene(parts, sound, options);
  Image picture = scene.picture(time);
  scene.finish(picture, time);
  if (progress.stopRequested()) return tl::unexpected(kStopped);
  return render::writePng(path, picture);
}

}  // namespace ifa

// SPDX-License-Identifier: Apache-2.0
// The stages of `ifa render`.
#include <algorithm>
#include <cmath>

#include "ifa/film.h"
#include "pipeline/ensemble_folder.h"
#include "pipeline/motion_folder.h"
#include "pipeline/write_film.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostMotions = 64;

tl::unexpected<Error> usage(std::string message, std::string place, std::string remedy) {
  return tl::unexpected<Error>(
      {ErrorCode::kUsage, std::move(message), std::move(place), std::move(remedy)});
}

enum class Kind { kFilm, kPng, kFolder };

Result<Kind> kindOf(const fs::path& output) {
  const std::string extension = output.extension().string();
  if (extension == ".mp4") return Kind::kFilm;
  if (extension == ".png") return Kind::kPng;
  std::error_code code;
  if (extension.empty() || fs::is_directory(output, code)) return Kind::kFolder;
  return usage("is neither a film, nor a picture, nor a folder", output.string(),
               "name a .mp4 or .png file, or a folder for a sequence");
}

/// What distinguishes the folders, for the pictures.
std::string nameOf(const MotionFolder& folder) {
  const std::string parent = fs::absolute(folder.file).parent_path().filename().string();
  return folder.file.filename() == "motion.json" ? parent : folder.file.stem().string();
}

Result<std::vector<MotionFolder>> readAll(const std::vector<fs::path>& motions) {
  if (motions.empty() || motions.size() > kMostMotions) {
    return usage("one to 64 motions can be shown", "MOTION", {});
  }
  std::vector<MotionFolder> folders;
  for (const fs::path& motion : motions) {
    auto folder = readMotionFolder(motion);
    if (!folder) return tl::unexpected(folder.error());
    folders.push_back(std::move(*folder));
  }
  return folders;
}

/// A sequence has a sound.wav beside its pictures, and replaces an older one.
Result<void> refuseToOverwrite(const fs::path& output, const std::vector<MotionFolder>& folders) {
  for (const MotionFolder& folder : folders) {
    std::error_code code;
    const bool own = fs::equivalent(output, fs::absolute(folder.file).parent_path(), code);
    if (!own && !isEnsemble(output)) continue;
    return usage("the motion's own sound would be overwritten", output.string(),
                 "choose another folder");
  }
  return {};
}

Result<void> write(Kind kind, const fs::path& output, const std::vector<FilmPart>& parts,
                   const Sound* sound, const FilmOptions& options, std::optional<double> still,
                   const Progress& progress, std::vector<std::string>& warnings) {
  if (kind == Kind::kFolder) return writeSequence(output, parts, sound, options, progress);
  if (kind == Kind::kPng) {
    return still ? writeStill(output, parts, sound, options, *still, progress)
                 : writeContactSheet(output, parts, options, progress);
  }
  const auto told = writeFilm(output, parts, sound, options, progress);
  if (!told) return tl::unexpected(told.error());
  if (!told->empty()) warnings.push_back(*told);
  return {};
}

/// What is to be shown, with all that it refers to.
struct Show {
  std::vector<MotionFolder> folders;
  std::vector<FilmPart> parts;
  std::optional<Sound> sound;
  std::vector<std::string> warnings;
};

Result<Show> readMotions(const std::vector<fs::path>& motions, bool withSound) {
  auto folders = readAll(motions);
  if (!folders) return tl::unexpected(folders.error());
  Show show;
  show.folders = std::move(*folders);
  if (withSound) {
    auto read = readSoundBeside(show.folders.front());
    if (!read) return tl::unexpected(read.error());
    show.sound = std::move(*read);
  }
  for (const MotionFolder& folder : show.folders) {
    show.parts.push_back({&folder.motion, &folder.body, nameOf(folder)});
  }
  return show;
}

/// Bodies where they are laid, each with its own first contact.
Result<Show> readWholeEnsemble(const fs::path& place, bool withSound) {
  auto folder = readEnsembleFolder(place);
  if (!folder) return tl::unexpected(folder.error());
  Show show;
  if (withSound) {
    auto read = readEnsembleSound(*folder, show.warnings);
    if (!read) return tl::unexpected(read.error());
    show.sound = std::move(*read);
  }
  show.folders = std::move(folder->bodies);
  for (std::size_t i = 0; i < show.folders.size(); ++i) {
    MotionFolder& body = show.folders[i];
    body.motion = folder->ensemble.bodies[i].place.apply(std::move(body.motion));
    show.parts.push_back({&body.motion, &body.body, folder->ensemble.bodies[i].name,
                          body.motion.sound.firstContact});
  }
  return show;
}

Result<Show> readShow(const std::vector<fs::path>& motions, bool withSound) {
  const bool any = std::any_of(motions.begin(), motions.end(), isEnsemble);
  if (!any) return readMotions(motions, withSound);
  if (motions.size() == 1) return readWholeEnsemble(motions.front(), withSound);
  return usage("an ensemble is shown alone", "MOTION", "name the one ensemble, or motions only");
}

}  // namespace

Result<std::vector<std::string>> renderMotions(const std::vector<fs::path>& motions,
                                               const fs::path& output, const FilmOptions& options,
                                               std::optional<double> still,
                                               const Progress& progress) {
  if (auto good = checkFilmOptions(withSize(options)); !good) return tl::unexpected(good.error());
  const auto kind = kindOf(output);
  if (!kind) return tl::unexpected(kind.error());
  if (still && (*kind != Kind::kPng || !std::isfinite(*still))) {
    return usage("goes with a PNG file and a time in seconds", "--at", {});
  }
  auto show = readShow(motions, *kind != Kind::kPng || options.overlay);
  if (!show) return tl::unexpected(show.error());
  if (*kind == Kind::kFolder) {
    if (auto good = refuseToOverwrite(output, show->folders); !good) {
      return tl::unexpected(good.error());
    }
  }
  std::vector<std::string> warnings = show->warnings;
  for (const MotionFolder& folder : show->folders) {
    warnings.insert(warnings.end(), folder.warnings.begin(), folder.warnings.end());
  }
  const auto written = write(*kind, output, show->parts, show->sound ? &*show->sound : nullptr,
                             options, still, progress, warnings);
  if (!written) return tl::unexpected(written.error());
  return warnings;
}

}  // namespace ifa

// SPDX-License-Identifier: Apache-2.0
// Films, contact sheets and picture sequences of motions in memory.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ifa/progress.h"
#include "ifa/result.h"
#include "pipeline/film_scene.h"

namespace ifa {

/// Writes an MP4 file, atomically. Returns what the user should know; mostly empty.
/// @param sound  the first part's, or none for a silent film
/// Errors: those of checkFilmOptions and of the encoder; kInterrupted, and then nothing is written.
[[nodiscard]] Result<std::string> writeFilm(const std::filesystem::path& path,
                                            const std::vector<FilmPart>& parts, const Sound* sound,
                                            const FilmOptions& options, const Progress& progress);

/// Writes frame-00001.png and so on into a folder, with sound.wav beside them; those of an earlier
/// run are replaced. Errors: as above.
[[nodiscard]] Result<void> writeSequence(const std::filesystem::path& folder,
                                         const std::vector<FilmPart>& parts, const Sound* sound,
                                         const FilmOptions& options, const Progress& progress);

/// Writes a PNG with one picture for each of markedContacts(), at most kMostSheetPictures,
/// evenly chosen. Errors: as above.
[[nodiscard]] Result<void> writeContactSheet(const std::filesystem::path& path,
                                             const std::vector<FilmPart>& parts,
                                             const FilmOptions& options, const Progress& progress);
inline constexpr std::size_t kMostSheetPictures = 60;

/// Writes one picture as PNG. Errors: as above.
/// @param time  of the sound, s
[[nodiscard]] Result<void> writeStill(const std::filesystem::path& path,
                                      const std::vector<FilmPart>& parts, const Sound* sound,
                                      const FilmOptions& options, double time,
                                      const Progress& progress);

}  // namespace ifa

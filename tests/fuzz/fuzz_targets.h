// SPDX-License-Identifier: Apache-2.0
// What the fuzzers call, one function for each reader of files from outside. Each takes any bytes,
// returns, and aborts where a promise of the reader is broken (what was read and written again must
// be read the same). scripts/fuzz.sh runs them with libFuzzer; corpus_test.cpp over
// tests/fuzz/corpus.
#pragma once

#include <array>
#include <string_view>

namespace ifa::fuzz {

void readAsLabels(std::string_view bytes);
void readAsCsv(std::string_view bytes);
void readAsMidi(std::string_view bytes);
void readAsCues(std::string_view bytes);
void readAsSignature(std::string_view bytes);
void readAsSound(std::string_view bytes);
void readAsObject(std::string_view bytes);
void readAsMesh(std::string_view bytes);
void readAsDatabase(std::string_view bytes);
void readAsScore(std::string_view bytes);
void readAsEnsemble(std::string_view bytes);
void readAsMotion(std::string_view bytes);

struct Target {
  std::string_view name;  ///< also of its folder in tests/fuzz/corpus
  void (*run)(std::string_view bytes);
};

inline constexpr std::array<Target, 12> kTargets = {{{"labels", readAsLabels},
                                                     {"csv", readAsCsv},
                                                     {"midi", readAsMidi},
                                                     {"cues", readAsCues},
                                                     {"signature", readAsSignature},
                                                     {"sound", readAsSound},
                                                     {"object", readAsObject},
                                                     {"mesh", readAsMesh},
                                                     {"database", readAsDatabase},
                                                     {"score", readAsScore},
                                                     {"ensemble", readAsEnsemble},
                                                     {"motion", readAsMotion}}};

}  // namespace ifa::fuzz

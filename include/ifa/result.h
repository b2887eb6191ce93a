// SPDX-License-Identifier: Apache-2.0
// What a call that can fail returns: a value, or an error that names the place and the remedy.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace ifa {

/// Kinds of expected failure; the values are the exit codes of the command line.
enum class ErrorCode {
  kUsage = 2,  ///< the call itself makes no sense
  kBadInput =
      3,  ///< a file, a line or a value that cannot be used, or an output that cannot be written
  kNoMotion = 4,     ///< the input is sound, but no acceptable motion was found
  kInterrupted = 5,  ///< the user asked to stop
  kInternal = 70,    ///< a bug of ours
};

/// An expected failure, told so that its reader can mend it.
struct Error {
  ErrorCode code = ErrorCode::kInternal;
  std::string message;  ///< what is wrong, without a full stop
  std::string place;    ///< file, file:line, flag or field; may be empty
  std::string remedy;   ///< what to do about it; may be empty

  /// "place: message (remedy)", leaving out what is empty.
  [[nodiscard]] std::string text() const {
    std::string all = place.empty() ? message : place + ": " + message;
    return remedy.empty() ? all : all + " (" + remedy + ")";
  }
};

template <class T>
using Result = tl::expected<T, Error>;

/// Shorthand for `return badInput(...)` in functions that return a Result.
inline tl::unexpected<Error> badInput(std::string message, std::string place = {},
                                      std::string remedy = {}) {
  return tl::unexpected<Error>(
      Error{ErrorCode::kBadInput, std::move(message), std::move(place), std::move(remedy)});
}

}  // namespace ifa

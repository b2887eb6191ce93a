// SPDX-License-Identifier: Apache-2.0
// Which notes of a Standard MIDI File are contacts.
#pragma once

namespace ifa {

/// The defaults take every note for a click.
struct MidiOptions {
  int track = 0;    ///< 1 for the first one in the file; 0: all that play together
  int channel = 0;  ///< 1 to 16; 0: all
  /// A note is a rattle until its end, not a click. Off, because the end of a note says when a key
  /// was let go: the notes of a tune would touch, and be one long contact.
  bool durations = false;
};

}  // namespace ifa

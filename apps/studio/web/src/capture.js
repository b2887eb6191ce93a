// SPDX-License-Identifier: Apache-2.0
// Runs in the audio thread: hands on what the microphone hears.
registerProcessor('capture', class extends AudioWorkletProcessor {
  process([input]) {
    if (input[0]) this.port.postMessage(input[0].slice());
    return true;
  }
});

// SPDX-License-Identifier: Apache-2.0
// The button that records, and stops and shows for how long.
import {button, toast} from './dom';
import {kMaxRecording, Recorder} from './recorder';

let recorder: Recorder | null = null;

/** Begins to record; the next call, or the longest recording, ends it. @param use gets the sound */
export async function recordOrStop(use: (sound: Blob) => Promise<void>): Promise<void> {
  const label = button('record');
  try {
    if (recorder) {
      const sound = await recorder.stop();
      recorder = null;
      label.textContent = 'Record';
      return await use(sound);
    }
    recorder = await Recorder.start();
  } catch (error) {
    recorder = null;
    return toast(`The microphone cannot be used: ${error instanceof Error ? error.message : String(error)}`);
  }
  const show = (): void => {
    if (!recorder) return;
    label.textContent = `Stop · ${recorder.seconds.toFixed(1)} s`;
    if (recorder.seconds >= kMaxRecording) void recordOrStop(use);
    else setTimeout(show, 100);
  };
  show();
}

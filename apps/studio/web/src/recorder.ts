// SPDX-License-Identifier: Apache-2.0
// The microphone as a sound file.
import captureUrl from './capture.js?url';

/** Longest recording, s. */
export const kMaxRecording = 60;

/** One channel as a WAV file of 16 bits. */
export function encodeWav(blocks: readonly Float32Array[], rate: number): Uint8Array<ArrayBuffer> {
  const count = blocks.reduce((sum, block) => sum + block.length, 0);
  const bytes = new Uint8Array(44 + 2 * count);
  const view = new DataView(bytes.buffer);
  const text = (at: number, word: string): void => [...word].forEach((c, i) => view.setUint8(at + i, c.charCodeAt(0)));
  text(0, 'RIFF');
  view.setUint32(4, 36 + 2 * count, true);
  text(8, 'WAVEfmt ');
  view.setUint32(16, 16, true);
  view.setUint16(20, 1, true); // PCM
  view.setUint16(22, 1, true); // channels
  view.setUint32(24, rate, true);
  view.setUint32(28, 2 * rate, true);
  view.setUint16(32, 2, true);
  view.setUint16(34, 16, true);
  text(36, 'data');
  view.setUint32(40, 2 * count, true);
  let at = 44;
  for (const block of blocks) {
    for (const sample of block) {
      view.setInt16(at, Math.round(32767 * Math.min(1, Math.max(-1, sample))), true);
      at += 2;
    }
  }
  return bytes;
}

export class Recorder {
  private readonly blocks: Float32Array[] = [];
  private samples = 0;

  private constructor(private readonly context: AudioContext, private readonly stream: MediaStream, node: AudioWorkletNode) {
    node.port.onmessage = ({data}: MessageEvent<Float32Array>) => {
      if (this.seconds >= kMaxRecording) return;
      this.blocks.push(data);
      this.samples += data.length;
    };
  }

  /** Asks for the microphone. What browsers do for speech would swallow the contacts. */
  static async start(): Promise<Recorder> {
    const plain = {echoCancellation: false, noiseSuppression: false, autoGainControl: false};
    const stream = await navigator.mediaDevices.getUserMedia({audio: plain});
    const context = new AudioContext();
    await context.audioWorklet.addModule(captureUrl);
    const node = new AudioWorkletNode(context, 'capture', {numberOfOutputs: 0});
    context.createMediaStreamSource(stream).connect(node);
    return new Recorder(context, stream, node);
  }

  get seconds(): number {
    return this.samples / this.context.sampleRate;
  }

  async stop(): Promise<Blob> {
    for (const track of this.stream.getTracks()) track.stop();
    await this.context.close();
    return new Blob([encodeWav(this.blocks, this.context.sampleRate)], {type: 'audio/wav'});
  }
}

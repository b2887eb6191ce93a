// SPDX-License-Identifier: Apache-2.0
// What is drawn of a sound, and where attacks lie in it. Pure.

/** Samples of one channel, and what makes drawing them quick. */
export class Waveform {
  /** Lowest and highest of each 64 samples. */
  private readonly low: Float32Array;
  private readonly high: Float32Array;
  readonly peak: number;

  constructor(readonly samples: Float32Array, readonly rate: number) {
    const blocks = Math.ceil(samples.length / 64);
    this.low = new Float32Array(blocks);
    this.high = new Float32Array(blocks);
    let peak = 1e-6;
    for (let block = 0; block < blocks; ++block) {
      const [low, high] = range(samples, 64 * block, 64 * block + 64);
      this.low[block] = low;
      this.high[block] = high;
      peak = Math.max(peak, -low, high);
    }
    this.peak = peak;
  }

  get duration(): number {
    return this.samples.length / this.rate;
  }

  /** Lowest and highest sample between two times, as shares of the loudest. */
  extent(from: number, to: number): [number, number] {
    const first = Math.max(0, Math.floor(from * this.rate));
    const last = Math.max(first + 1, Math.ceil(to * this.rate));
    let low = 0;
    let high = 0;
    if (last - first < 256) {
      [low, high] = range(this.samples, first, last);
    } else {
      low = range(this.low, first >> 6, (last >> 6) + 1)[0];
      high = range(this.high, first >> 6, (last >> 6) + 1)[1];
    }
    return [low / this.peak, high / this.peak];
  }
}

function range(values: Float32Array, from: number, to: number): [number, number] {
  const end = Math.min(to, values.length);
  if (from >= end) return [0, 0];
  let low = Infinity;
  let high = -Infinity;
  for (let i = from; i < end; ++i) {
    const value = values[i]!;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}

/** Energy of the sample-to-sample differences (attacks are bright) between two times. */
function brightEnergy(wave: Waveform, from: number, to: number): number {
  const first = Math.max(1, Math.round(from * wave.rate));
  const last = Math.min(wave.samples.length, Math.round(to * wave.rate));
  let sum = 0;
  for (let i = first; i < last; ++i) sum += (wave.samples[i]! - wave.samples[i - 1]!) ** 2;
  return last > first ? sum / (last - first) : 0;
}

/** By how many dB the 2 ms after a time are louder than the 8 ms before it. */
function rise(wave: Waveform, time: number): number {
  const floor = 1e-8 * wave.peak * wave.peak;
  const after = brightEnergy(wave, time, time + 0.002) + floor;
  return 10 * Math.log10(after / (brightEnergy(wave, time - 0.008, time) + floor));
}

/** The start of the steepest attack within `reach` seconds of a time; null where nothing rises by 3 dB. */
export function nearestOnset(wave: Waveform, time: number, reach = 0.02): number | null {
  const step = 0.00025;
  let best: number | null = null;
  let most = 3;
  for (let at = Math.max(0, time - reach); at <= Math.min(wave.duration, time + reach); at += step) {
    const value = rise(wave, at) - 100 * Math.abs(at - time); // a little for being near: 1 dB in 10 ms
    if (value > most) {
      most = value;
      best = at;
    }
  }
  return best;
}

/** Power of two real FFT, magnitudes only. */
export class Spectrum {
  private readonly re: Float32Array;
  private readonly im: Float32Array;
  private readonly window: Float32Array;
  private readonly cos: Float32Array;
  private readonly sin: Float32Array;
  readonly power: Float32Array;

  constructor(readonly size: number) {
    this.re = new Float32Array(size);
    this.im = new Float32Array(size);
    this.power = new Float32Array(size / 2);
    this.window = Float32Array.from({length: size}, (_, i) => 0.5 - 0.5 * Math.cos((2 * Math.PI * i) / size));
    this.cos = Float32Array.from({length: size / 2}, (_, i) => Math.cos((2 * Math.PI * i) / size));
    this.sin = Float32Array.from({length: size / 2}, (_, i) => -Math.sin((2 * Math.PI * i) / size));
  }

  /** Power in each band around the sample `centre`, in `power`. */
  at(samples: Float32Array, centre: number): void {
    const {re, im, size} = this;
    const first = centre - (size >> 1);
    for (let i = 0, j = 0; i < size; ++i) {
      re[j] = (samples[first + i] ?? 0) * this.window[i]!;
      im[j] = 0;
      let bit = size >> 1; // j counts in reversed bits
      while (bit > 0 && (j & bit) !== 0) {
        j ^= bit;
        bit >>= 1;
      }
      j |= bit;
    }
    for (let half = 1; half < size; half *= 2) this.butterflies(half);
    for (let i = 0; i < size / 2; ++i) this.power[i] = re[i]! * re[i]! + im[i]! * im[i]!;
  }

  private butterflies(half: number): void {
    const {re, im, cos, sin, size} = this;
    const stride = size / (2 * half);
    for (let start = 0; start < size; start += 2 * half) {
      for (let i = 0; i < half; ++i) {
        const c = cos[i * stride]!;
        const s = sin[i * stride]!;
        const a = start + i;
        const b = a + half;
        const x = re[b]! * c - im[b]! * s;
        const y = re[b]! * s + im[b]! * c;
        re[b] = re[a]! - x;
        im[b] = im[a]! - y;
        re[a] = re[a]! + x;
        im[a] = im[a]! + y;
      }
    }
  }
}

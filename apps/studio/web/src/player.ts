// SPDX-License-Identifier: Apache-2.0
// Plays a sound and knows which moment of it is being heard, by the audio clock.

export interface Span {
  from: number;
  to: number;
}

export class Player {
  private context: AudioContext | null = null;
  private source: AudioBufferSourceNode | null = null;
  private startedAt = 0; // of the context's clock
  private startedFrom = 0; // of the sound
  private resting = 0; // where it stands while it does not play
  private loop: Span;
  speed = 1;
  onStop: () => void = () => {};

  constructor(private readonly bytes: ArrayBuffer, readonly duration: number) {
    this.loop = {from: 0, to: duration};
  }

  private buffer: AudioBuffer | null = null;

  get playing(): boolean {
    return this.source !== null;
  }
  get span(): Span {
    return this.loop;
  }
  get loops(): boolean {
    return this.loop.from > 0 || this.loop.to < this.duration;
  }

  /** What is heard now, s in the sound. currentTime runs ahead of the loudspeaker; this does not. */
  get position(): number {
    if (!this.source || !this.context) return this.resting;
    const stamp = this.context.getOutputTimestamp();
    const since = stamp.performanceTime ? (performance.now() - stamp.performanceTime) / 1000 : 0;
    const heard = stamp.contextTime !== undefined && stamp.performanceTime ? stamp.contextTime + since : this.context.currentTime;
    const gone = Math.max(0, heard - this.startedAt) * this.speed;
    const at = this.startedFrom + gone;
    const length = this.loop.to - this.loop.from;
    return at < this.loop.to ? at : this.loop.from + ((at - this.loop.from) % length);
  }

  async play(): Promise<void> {
    // A context may only be made when a person has asked for sound.
    this.context ??= new AudioContext({latencyHint: 'interactive'});
    await this.context.resume();
    this.buffer ??= await this.context.decodeAudioData(this.bytes.slice(0));
    this.stopSource();
    const from = this.resting >= this.loop.from && this.resting < this.loop.to - 0.005 ? this.resting : this.loop.from;
    const source = this.context.createBufferSource();
    source.buffer = this.buffer;
    source.playbackRate.value = this.speed;
    source.loop = true;
    source.loopStart = this.loop.from;
    source.loopEnd = this.loop.to;
    source.connect(this.context.destination);
    this.startedAt = this.context.currentTime + 0.03;
    this.startedFrom = from;
    source.start(this.startedAt, from);
    this.source = source;
  }

  pause(): void {
    this.resting = this.position;
    this.stopSource();
    this.onStop();
  }

  seek(time: number): void {
    this.resting = Math.min(Math.max(time, 0), this.duration);
    if (this.playing) void this.play();
  }

  async setSpeed(speed: number): Promise<void> {
    this.resting = this.position;
    this.speed = speed;
    if (this.playing) await this.play();
  }

  async setSpan(span: Span | null): Promise<void> {
    this.resting = this.position;
    this.loop = span ?? {from: 0, to: this.duration};
    if (this.playing) await this.play();
  }

  close(): void {
    this.stopSource();
    void this.context?.close();
  }

  private stopSource(): void {
    this.source?.stop();
    this.source?.disconnect();
    this.source = null;
  }
}

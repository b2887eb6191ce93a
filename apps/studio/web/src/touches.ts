// SPDX-License-Identifier: Apache-2.0
// Which moment a frame shows: the one that is heard, or the contact that falls into the frame. Pure.

/** Frames come when they come, mostly between contacts; so that every contact is seen, a frame shows the one next to it. */
export class Touches {
  private last = NaN;
  private seen = -Infinity;

  /** @param time heard, s  @param contacts in order, s  @returns what to show: at most one frame off, s */
  shown(time: number, contacts: readonly number[]): number {
    const frame = time - this.last;
    this.last = time;
    // Stopped, gone back, or so slow that a frame off would be seen.
    if (!(frame > 0 && frame <= 0.1)) {
      this.seen = -Infinity;
      return time;
    }
    let best = NaN;
    for (const contact of contacts) {
      const near = contact > time - frame && contact <= time + frame / 2;
      if (near && contact > this.seen && !(Math.abs(best - time) <= Math.abs(contact - time))) best = contact;
    }
    if (Number.isNaN(best)) return time;
    return (this.seen = best);
  }
}

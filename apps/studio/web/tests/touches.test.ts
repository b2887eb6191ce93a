// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import {Touches} from '../src/touches';

describe('frames', () => {
  it('show every contact once, at most a frame off', () => {
    const contacts = [0.1, 0.237, 0.3, 0.5];
    for (const rate of [60, 30, 17.3]) {
      const touches = new Touches();
      const shown = new Map<number, number>();
      for (let time = 0.003; time < 0.7; time += (0.8 + 0.4 * Math.abs(Math.sin(1e4 * time))) / rate) {
        const at = touches.shown(time, contacts);
        expect(Math.abs(at - time)).toBeLessThan(1.2 / rate);
        if (contacts.includes(at)) shown.set(at, (shown.get(at) ?? 0) + 1);
      }
      expect([...shown.keys()], String(rate)).toEqual(contacts);
      expect([...shown.values()]).toEqual([1, 1, 1, 1]);
    }
  });
  it('show what is heard where nothing plays or all is slow', () => {
    const touches = new Touches();
    expect(touches.shown(0.099, [0.1])).toBe(0.099);
    expect(touches.shown(0.099, [0.1])).toBe(0.099);
    expect(touches.shown(0.05, [0.1])).toBe(0.05);
    expect(touches.shown(0.2, [0.1])).toBe(0.2);
  });
  it('begin anew when the sound does', () => {
    const touches = new Touches();
    for (let pass = 0; pass < 2; ++pass) {
      touches.shown(0.08, [0.1]);
      expect(touches.shown(0.097, [0.1])).toBe(0.1);
      expect(touches.shown(0.114, [0.1])).toBe(0.114);
    }
  });
});

// SPDX-License-Identifier: Apache-2.0
// How far a contact was bent to fit the sound, as a colour and in words. Pure.
import type {Motion, MotionContact} from './api';
import type {Mark} from './marks';

const kStops: readonly [number, number, number][] = [[47, 143, 107], [217, 165, 32], [200, 69, 47]];

/** @param share of the most that is allowed, 0 to 1 */
export function bendColour(share: number): string {
  const at = Math.min(Math.max(share, 0), 1) * (kStops.length - 1);
  const i = Math.min(Math.floor(at), kStops.length - 2);
  const low = kStops[i]!;
  const high = kStops[i + 1]!;
  const hex = low.map((value, c) => Math.round(value + (high[c]! - value) * (at - i)).toString(16).padStart(2, '0'));
  return `#${hex.join('')}`;
}

/** For each mark that the motion meets, the index of its contact. */
export function contactsOfMarks(marks: readonly Mark[], motion: Motion): Map<number, number> {
  const first = marks[0]?.start ?? 0;
  const found = new Map<number, number>();
  motion.contacts.forEach((contact, i) => {
    const time = first + contact.target_time;
    let best: Mark | null = null;
    for (const mark of marks) {
      if (!best || Math.abs(mark.start - time) < Math.abs(best.start - time)) best = mark;
    }
    if (best && Math.abs(best.start - time) < 0.015) found.set(best.id, i);
  });
  return found;
}

const kFactors: Record<string, string> = {
  v: 'velocity', q: 'orientation', t: 'pace', a: 'loudness', l: 'length', c: 'centre', o: 'face asked for', p: 'place asked for',
};

export function explain(contact: MotionContact, index: number, cap: number, soundTime: number): string {
  const factors = Object.entries(contact.factors)
    .filter(([, value]) => value < 0.995)
    .map(([name, value]) => `${kFactors[name] ?? name} ${value.toFixed(2)}`);
  const off = Math.round(1e4 * (contact.time - contact.target_time)) / 10;
  return [
    `Contact ${index + 1} at ${soundTime.toFixed(3)} s${off === 0 ? '' : `, ${off > 0 ? '+' : ''}${off} ms off`}`,
    `bend ${contact.bend.toFixed(2)} of ${cap.toFixed(1)} allowed`,
    factors.length > 0 ? `fit (1 is perfect): ${factors.join(', ')}` : 'fits perfectly',
  ].join('\n');
}

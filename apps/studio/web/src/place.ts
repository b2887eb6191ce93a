// SPDX-License-Identifier: Apache-2.0
// Places on the floor. Pure.

/** x and y of the motion, m. */
export type Place = [number, number];

/** How far it is, in a unit that suits. */
export function lengthText([x, y]: Place): string {
  const length = Math.hypot(x, y);
  if (length < 0.01) return `${(1000 * length).toFixed(0)} mm`;
  return length < 1 ? `${(100 * length).toFixed(1)} cm` : `${length.toFixed(2)} m`;
}

/** The same way, so far that neither x nor y is more than `most`. */
export function limited([x, y]: Place, most: number): Place {
  const shorter = Math.min(1, most / Math.max(Math.abs(x), Math.abs(y), 1e-9));
  return [x * shorter, y * shorter];
}

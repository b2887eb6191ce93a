// SPDX-License-Identifier: Apache-2.0
import {expect, it} from 'vitest';
import {lengthText, limited} from '../src/place';

it('a place on the floor is told in a unit that suits, and kept near', () => {
  expect([[0.004, 0], [0.2, 0.1], [3, 4]].map(([x, y]) => lengthText([x!, y!]))).toEqual(['4 mm', '22.4 cm', '5.00 m']);
  expect(limited([200, -50], 100)).toEqual([100, -25]);
  expect(limited([0, 0], 100)).toEqual([0, 0]);
});

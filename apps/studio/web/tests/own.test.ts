// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import {explainMesh, firstGuess, guessUnits, massOf, meshKindOf, objectRequest, sizeText, type MeshReport, type OwnMesh} from '../src/own';

/** A box of 30 x 20 x 10 in millimetres. */
const box: MeshReport = {triangles: 12, vertices: 8, openEdges: 0, inconsistentEdges: 0, degenerateTriangles: 0,
                         area: 2200, volume: 6000, extent: [30, 20, 10], solid: true};
const open: MeshReport = {...box, triangles: 10, openEdges: 4, solid: false};
const mesh = (report: MeshReport, kind = 'stl'): OwnMesh => ({name: `box.${kind}`, kind, report});

describe('an own mesh', () => {
  it('is known by its name', () => {
    expect(['a.STL', 'b.obj', 'x.y.glb'].map(meshKindOf)).toEqual(['stl', 'obj', 'glb']);
    expect(['a.wav', 'stl', 'a.stl.txt'].map(meshKindOf)).toEqual([null, null, null]);
  });
  it('has the units in which one would throw it', () => {
    expect(guessUnits('stl', [30, 20, 10])).toBe('mm');
    expect(guessUnits('obj', [0.03, 0.02, 0.01])).toBe('m');
    expect(guessUnits('ply', [3, 2, 1])).toBe('cm');
    expect(guessUnits('glb', [30, 20, 10])).toBe('m');
    expect(sizeText(box, 'mm')).toBe('30 × 20 × 10 mm');
    expect(sizeText(box, 'in')).toBe('762 × 508 × 254 mm');
  });
  it('weighs what its material weighs, or what a person says', () => {
    const wood = {...firstGuess(mesh(box)), material: 'wood'};
    expect(massOf(box, wood)).toBeCloseTo(4.2, 6); // 6 cm³ at 0.7 g/cm³
    expect(massOf(box, {...wood, units: 'cm'})).toBeCloseTo(4200, 3);
    expect(massOf(box, {...wood, shell: true, wall: 2})).toBeCloseTo(22 * 0.2 * 0.7, 6);
    expect(massOf(box, {...wood, mass: 17})).toBe(17);
    expect(objectRequest(box, {...wood, mass: 17})).toEqual({units: 'mm', shell: false, mass: 0.017, restitution: 0.5, friction: 0.4});
  });
  it('is explained', () => {
    const good = firstGuess(mesh(box));
    expect(explainMesh(box, good)).toEqual({good: true, texts: []});
    const shell = firstGuess(mesh(open));
    expect(shell.shell).toBe(true);
    expect(explainMesh(open, shell).texts[0]).toMatch(/^It has holes: at 4 edges/);
    expect(explainMesh(open, shell).good).toBe(true);
    expect(explainMesh(open, {...shell, shell: false}).good).toBe(false);
    expect(explainMesh(open, {...shell, wall: 0}).good).toBe(false);
    const huge = explainMesh(box, {...good, units: 'm'});
    expect(huge.good).toBe(false);
    expect(huge.texts.join()).toMatch(/Nothing of 30 m can be thrown/);
    expect(explainMesh(box, {...good, mass: 200}).texts.join()).toMatch(/heavier than gold/);
    expect(explainMesh(box, {...good, mass: 0}).good).toBe(false);
  });
});

// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import {encodeWav} from '../src/recorder';
import {emptySaved, readProject, readSaved, writeProject} from '../src/saved';

const own = {name: 'thing', units: 'mm' as const, material: 'wood', shell: false, wall: 1, mass: 20, picture: ''};
const saved = {...emptySaved(), object: 'd6', own, landing: [0.2, -0.1] as [number, number], marking: {marks: [{id: 1, start: 0.1, end: 0.1, confidence: 1}], terminal: false}};

describe('what is saved', () => {
  it('comes back', () => {
    expect(readSaved(JSON.parse(JSON.stringify(saved)))).toEqual(saved);
    const sound = Uint8Array.from({length: 100000}, (_, i) => i % 256);
    expect(readProject(writeProject({name: 'a.wav', sound, saved, mesh: null}))).toEqual({name: 'a.wav', sound, saved, mesh: null});
    const small = {name: 'a.wav', sound: Uint8Array.of(1), saved, mesh: {name: 'thing.stl', bytes: Uint8Array.of(0, 255, 7)}};
    expect(readProject(writeProject(small))).toEqual(small);
    const {own: _, landing: __, ...older} = saved;
    expect(readSaved(older)).toEqual({...saved, own: null, landing: null});
  });
  it('is nothing where a field is wrong', () => {
    const broken: Record<string, unknown>[] = [
      {version: 2}, {object: 5}, {takes: '3'}, {seed: null}, {fit: 1}, {marking: null}, {marking: {marks: [{id: 1}], terminal: true}},
      {marking: {marks: 'x', terminal: true}}, {plan: {number: 1, takes: 1e9, marks: [], failure: ''}}, {plan: 5},
      {landing: 5}, {landing: [1]}, {landing: [0, '1']}, {landing: [0, 101]}, {landing: [NaN, 0]}, {own: 5}, {own: {...own, units: 'toString'}}, {own: {...own, picture: 'url(x)'}}, {own: {...own, wall: 0}},
    ];
    for (const wrong of broken) expect(readSaved({...saved, ...wrong}), JSON.stringify(wrong)).toBeNull();
    for (const other of [null, 5, 'x', []]) expect(readSaved(other)).toBeNull();
    for (const text of ['', '{', '{}', 'RIFF', writeProject({name: '', sound: new Uint8Array(), saved, mesh: null}).replace('"sound":"', '"sound":"%')]) {
      expect(readProject(text)).toBeNull();
    }
  });
});

describe('a recording', () => {
  it('is a WAV file', () => {
    const bytes = encodeWav([Float32Array.of(0, 1), Float32Array.of(-2)], 48000);
    expect(bytes.length).toBe(50);
    expect(String.fromCharCode(...bytes.subarray(0, 4), ...bytes.subarray(8, 12))).toBe('RIFFWAVE');
    expect([...new Int16Array(bytes.buffer, 44)]).toEqual([0, 32767, -32767]);
  });
});

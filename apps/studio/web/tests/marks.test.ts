// SPDX-License-Identifier: Apache-2.0
import {describe, expect, it} from 'vitest';
import {EventParser} from '../src/api';
import {added, ended, History, isClick, labelTrack, mergedWithNext, moved, removed, split, type Mark} from '../src/marks';
import {nearestOnset, Spectrum, Waveform} from '../src/signal';

const click = (id: number, start: number): Mark => ({id, start, end: start, confidence: 0.5});
const three = [click(1, 0.1), click(2, 0.3), {id: 3, start: 0.5, end: 0.7, confidence: 1}];

describe('marks', () => {
  it('moves as far as the neighbours let it', () => {
    expect(moved(three, 2, 0.05, 1)[1]!.start).toBeCloseTo(0.101, 6);
    expect(moved(three, 2, 0.9, 1)[1]!.start).toBeCloseTo(0.499, 6);
    expect(moved(three, 3, 0.95, 1)[2]).toMatchObject({start: 0.8, end: 1});
    expect(moved(three, 2, 0.31, 1)[1]!.confidence).toBe(1);
  });
  it('adds in order, and not where there is one', () => {
    expect(added(three, 0.2, 1).map((mark) => mark.id)).toEqual([1, 4, 2, 3]);
    expect(added(three, 0.6, 1)).toEqual(three);
    expect(added(three, 1.2, 1)).toEqual(three);
  });
  it('splits a rattle and merges it again', () => {
    const parts = split(three, 3, 0.55);
    expect(parts).toHaveLength(4);
    expect(parts[2]!.end).toBeLessThan(parts[3]!.start);
    expect(mergedWithNext(parts, 3)[2]).toMatchObject({start: 0.5, end: 0.7});
    expect(split(three, 1, 0.1)).toEqual(three);
    expect(mergedWithNext(three, 3)).toEqual(three);
  });
  it('makes a click of what is too short', () => {
    expect(isClick(ended(three, 3, 0.502, 1)[2]!)).toBe(true);
    expect(ended(three, 2, 0.9, 1)[1]!.end).toBeCloseTo(0.499, 6);
    expect(removed(three, 2)).toHaveLength(2);
  });
  it('writes labels as Audacity does', () => {
    expect(labelTrack({marks: three, terminal: true})).toBe(
      '0.100000\t0.100000\tc1\n0.300000\t0.300000\tc2\n0.500000\t0.700000\tterminal\n');
    expect(labelTrack({marks: [click(1, 1)], terminal: false})).toBe('1.000000\t1.000000\tnon-terminal\n');
  });
  it('undoes a whole drag at once', () => {
    const history = new History(0);
    for (const value of [1, 2, 3]) history.set(value, 'drag');
    history.set(4);
    history.undo();
    expect(history.present).toBe(3);
    history.undo();
    expect(history.present).toBe(0);
    history.redo();
    history.redo();
    expect(history.present).toBe(4);
    expect(history.canRedo).toBe(false);
  });
});

describe('signal', () => {
  const rate = 44100;
  const samples = new Float32Array(rate);
  for (let i = 0; i < 2000; ++i) samples[13230 + i] = Math.exp(-i / 300) * Math.cos(i * 0.8);
  const wave = new Waveform(samples, rate);
  it('finds an attack to the millisecond, and none in silence', () => {
    expect(Math.abs(nearestOnset(wave, 0.309)! - 0.3)).toBeLessThan(0.001);
    expect(nearestOnset(wave, 0.8)).toBeNull();
  });
  it('shows peaks at any zoom', () => {
    expect(wave.extent(0.29, 0.32)[1]).toBeCloseTo(1, 5);
    expect(wave.extent(0, 1)[1]).toBeCloseTo(1, 5);
    expect(wave.extent(0.5, 0.6)[1]).toBeLessThan(0.01);
  });
  it('tells frequencies', () => {
    const tone = Float32Array.from({length: 1024}, (_, i) => Math.sin((2 * Math.PI * 40 * i) / 512));
    const spectrum = new Spectrum(512);
    spectrum.at(tone, 512);
    expect(spectrum.power.indexOf(Math.max(...spectrum.power))).toBe(40);
  });
});

describe('events', () => {
  it('are read in whatever pieces they come', () => {
    const heard: string[] = [];
    const parser = new EventParser((name, data) => heard.push(`${name} ${JSON.stringify(data)}`));
    for (const piece of ['event: pro', 'gress\ndata: {"value":0.5}\n', '\nevent: done\ndata: {}\n\n']) parser.add(piece);
    expect(heard).toEqual(['progress {"value":0.5}', 'done {}']);
  });
});

// SPDX-License-Identifier: Apache-2.0
// What a reload or a project file brings back. Pure.
import type {Mark, Marking} from './marks';
import {isOwnObject, meshKindOf, type OwnObject} from './own';

export interface Saved {
  version: 1;
  marking: Marking;
  object: string;
  /** Where that is one's own. */
  own: OwnObject | null;
  surface: string;
  face: string;
  /** Of the last contact in the plane, m from the first; null: anywhere. */
  landing: [number, number] | null;
  fit: boolean;
  takes: number;
  seed: number;
  plan: {number: number; takes: number; marks: readonly Mark[]; failure: string} | null;
  take: number;
}

export function emptySaved(): Saved {
  return {version: 1, marking: {marks: [], terminal: true}, object: '', own: null, surface: '', face: '', landing: null,
          fit: false, takes: 3, seed: 1, plan: null, take: 1};
}

type Fields = Record<string, unknown>;
const isObject = (value: unknown): value is Fields => typeof value === 'object' && value !== null;
const isNumber = (value: unknown): value is number => typeof value === 'number' && Number.isFinite(value);

function isMark(value: unknown): value is Mark {
  return isObject(value) && ['id', 'start', 'end', 'confidence'].every((name) => isNumber(value[name]));
}

/** Farthest landing along each axis that the studio takes, m. */
export const kMaxLanding = 100;

function isLanding(value: unknown): boolean {
  return value === null || (Array.isArray(value) && value.length === 2 &&
    value.every((one) => isNumber(one) && Math.abs(one) <= kMaxLanding));
}

const areMarks = (value: unknown): value is Mark[] => Array.isArray(value) && value.every(isMark);

function isPlan(value: unknown): boolean {
  return value === null || (isObject(value) && isNumber(value['number']) && isNumber(value['takes']) &&
    value['takes'] <= 6 && areMarks(value['marks']) && typeof value['failure'] === 'string');
}

/** The state if it is one, in every field; else null. */
export function readSaved(value: unknown): Saved | null {
  if (!isObject(value) || value['version'] !== 1 || !isObject(value['marking'])) return null;
  const {marks, terminal} = value['marking'];
  const good = areMarks(marks) && typeof terminal === 'boolean' && isPlan(value['plan']) && typeof value['fit'] === 'boolean' &&
    ['object', 'surface', 'face'].every((name) => typeof value[name] === 'string') &&
    ['takes', 'seed', 'take'].every((name) => isNumber(value[name]));
  const {own = null, landing = null} = value; // there were none in earlier versions
  return good && (own === null || isOwnObject(own)) && isLanding(landing) ? ({...value, own, landing} as unknown as Saved) : null;
}

/** A session in one file: its sound and all that was done. Takes are planned anew from it, and are the same. */
export interface Project {
  name: string;
  sound: Uint8Array<ArrayBuffer>;
  saved: Saved;
  /** The mesh of one's own object, as it was sent. */
  mesh: {name: string; bytes: Uint8Array<ArrayBuffer>} | null;
}

const kFormat = 'inverse-foley-project';

function encode(bytes: Uint8Array): string {
  let text = '';
  for (let at = 0; at < bytes.length; at += 0x8000) text += String.fromCharCode(...bytes.subarray(at, at + 0x8000));
  return btoa(text);
}

const decode = (text: string): Uint8Array<ArrayBuffer> => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

export function writeProject({name, sound, saved, mesh}: Project): string {
  const own = mesh && {name: mesh.name, bytes: encode(mesh.bytes)};
  return JSON.stringify({format: kFormat, version: 1, name, state: saved, sound: encode(sound), mesh: own});
}

function readMesh(value: unknown): Project['mesh'] {
  if (!isObject(value) || typeof value['name'] !== 'string' || typeof value['bytes'] !== 'string') return null;
  return meshKindOf(value['name']) ? {name: value['name'], bytes: decode(value['bytes'])} : null;
}

/** Null where the text is no project. */
export function readProject(text: string): Project | null {
  try {
    const value = JSON.parse(text) as unknown;
    if (!isObject(value) || value['format'] !== kFormat || value['version'] !== 1) return null;
    const saved = readSaved(value['state']);
    const {name, sound} = value;
    if (!saved || typeof name !== 'string' || typeof sound !== 'string') return null;
    return {name, saved, sound: decode(sound), mesh: readMesh(value['mesh'])};
  } catch {
    return null;
  }
}

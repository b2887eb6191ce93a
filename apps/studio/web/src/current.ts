// SPDX-License-Identifier: Apache-2.0
// What the page is about at the moment, and who wants to know when that changes.
import * as api from './api';
import {tellError} from './dom';
import {History, type Mark, type Marking} from './marks';
import {kMaterials, kOwnObject, massOf, roundTo3} from './own';
import type {Player} from './player';
import {emptySaved, type Saved} from './saved';
import type {Waveform} from './signal';
import type {TakeScene} from './stage';

export interface Take {
  motion: api.Motion;
  /** Null where the browser draws no 3D. */
  scene: TakeScene | null;
  button: HTMLButtonElement;
  canvas: HTMLCanvasElement;
}

interface Current {
  catalogue: api.CatalogueObject[];
  session: api.Session | null;
  wave: Waveform | null;
  player: Player | null;
  history: History<Marking>;
  /** The contact that keys act on. */
  chosen: number | null;
  saved: Saved;
  takes: Take[];
}

export const current: Current = {
  catalogue: [], session: null, wave: null, player: null,
  history: new History<Marking>({marks: [], terminal: true}), chosen: null, saved: emptySaved(), takes: [],
};

// ---- changes -------------------------------------------------------------------------------------

/** Contacts; the part that is played; object and wishes; takes, or which of them is chosen; whether a job runs. */
export type Topic = 'marks' | 'loop' | 'choice' | 'takes' | 'job';
const listeners: Record<Topic, (() => void)[]> = {marks: [], loop: [], choice: [], takes: [], job: []};

export function whenChanged(topics: readonly Topic[], show: () => void): void {
  for (const topic of topics) listeners[topic].push(show);
}

export function changed(topic: Topic): void {
  for (const show of listeners[topic]) show();
}

let saveTimer = 0;
/** Has the studio keep what is saved, a moment later. */
export function save(): void {
  current.saved.marking = current.history.present;
  clearTimeout(saveTimer);
  const id = current.session?.session;
  if (!id) return;
  saveTimer = window.setTimeout(() => {
    api.saveState(id, current.saved).catch(tellError);
  }, 250);
}

// ---- what follows from it ------------------------------------------------------------------------

export const chosenMark = (): Mark | undefined => current.history.present.marks.find((mark) => mark.id === current.chosen);

export const chosenTake = (): Take | undefined => current.takes[current.saved.take - 1];

export function chosenObject(): api.CatalogueObject | undefined {
  const {saved, session, catalogue} = current;
  if (saved.object !== kOwnObject) return catalogue.find((one) => one.name === saved.object);
  const {own} = saved;
  if (!own || !session?.mesh) return undefined;
  const material = `${kMaterials[own.material]!.name}, ${roundTo3(massOf(session.mesh.report, own))} g`;
  return {name: kOwnObject, title: own.name, material, surface: 'desk', surfaces: ['desk'], faces: {}};
}

/** Whether the takes were made for other contacts than there are now. */
export function stale(): boolean {
  const {plan} = current.saved;
  if (!plan) return false;
  const times = (marks: readonly Mark[]): string => marks.map((mark) => `${mark.start} ${mark.end}`).join();
  return times(plan.marks) !== times(current.history.present.marks);
}

/** The sound's name without its ending, for names of files. */
export const stem = (): string => (current.session?.name || 'sound').replace(/\.[^.]*$/, '');

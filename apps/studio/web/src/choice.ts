// SPDX-License-Identifier: Apache-2.0
// What fell, and how: the object, one of the library's or one's own, its faces, and the options.
import * as api from './api';
import {changed, chosenObject, current, save, whenChanged} from './current';
import {$, input, select, toast, whileBusy} from './dom';
import {MeshSheet} from './mesh_sheet';
import {pictureOf} from './objects';
import {kOwnObject, meshKindOf, type OwnObject} from './own';
import {demandFace} from './planning';

whenChanged(['choice'], show);

const facesOf = (object: api.CatalogueObject | undefined): string[] =>
  Object.keys(object?.faces ?? {}).sort((a, b) => a.localeCompare(b, 'en', {numeric: true}));

function show(): void {
  const {saved} = current;
  const object = chosenObject();
  const picture = $('object').querySelector<HTMLElement>('.picture')!;
  picture.style.backgroundImage = !object ? 'none' : object.name === kOwnObject ? `url("${saved.own?.picture ?? ''}")` : pictureOf(object.name);
  $('own-change').hidden = object?.name !== kOwnObject;
  picture.textContent = object ? '' : '?';
  $('object-title').textContent = object?.title ?? 'Choose an object';
  $('object-note').textContent = object ? object.material || 'change…' : 'what made the sound?';
  const faces = facesOf(object);
  $('face-row').hidden = faces.length === 0;
  $('faces').replaceChildren(...['', ...faces].map(faceChip));
  const surface = select('surface');
  surface.replaceChildren(...(object?.surfaces ?? []).map((name) => new Option(name, name)));
  surface.value = saved.surface || object?.surface || '';
  $('surface-row').hidden = (object?.surfaces.length ?? 0) < 2;
  select('takes').value = String(saved.takes);
  input('fit').checked = saved.fit;
  input('seed').value = String(saved.seed);
}

function faceChip(face: string): HTMLElement {
  const chip = document.createElement('button');
  chip.textContent = face || 'any';
  chip.setAttribute('role', 'radio');
  chip.setAttribute('aria-checked', String(face === current.saved.face));
  chip.setAttribute('aria-label', face ? `${face} up` : 'any face up');
  chip.addEventListener('click', () => demandFace(face));
  return chip;
}

/** Dice first: what most sounds here are of. */
export function inOrder(list: readonly api.CatalogueObject[]): api.CatalogueObject[] {
  const isDie = ({name}: api.CatalogueObject): boolean => /^d\d+$/.test(name);
  const dice = list.filter(isDie).sort((a, b) => facesOf(a).length - facesOf(b).length);
  return [...dice, ...list.filter((one) => !isDie(one))];
}

export function chooseObject(name: string): void {
  if (name !== current.saved.object) Object.assign(current.saved, {object: name, surface: '', face: ''});
  $<HTMLDialogElement>('objects').close();
  changed('choice');
  save();
}

// ---- an object of one's own ----------------------------------------------------------------------

const sheet = new MeshSheet(useOwn, () => $('mesh-file').click());

export async function openMesh(file: Blob, name: string): Promise<void> {
  const opened = current.session;
  const kind = meshKindOf(name);
  if (!opened) return toast('First the sound, then the object that made it.');
  if (!kind) return toast('A mesh is wanted: OBJ, STL, PLY, OFF or GLB.');
  await whileBusy(async () => {
    opened.mesh = await api.sendMesh(opened.session, file, name, kind);
    if (current.session !== opened) return;
    // The one before is no more.
    current.saved.own = null;
    if (current.saved.object === kOwnObject) current.saved.object = '';
    $<HTMLDialogElement>('objects').close();
    changed('choice');
    save();
    sheet.open(opened.session, opened.mesh, null);
  });
}

/** What was said of the session's mesh; where it has none, to choose one. */
export function openOwn(): void {
  const {session, saved} = current;
  if (!session?.mesh) return $('mesh-file').click();
  $<HTMLDialogElement>('objects').close();
  sheet.open(session.session, session.mesh, saved.own);
}

function useOwn(own: OwnObject): void {
  Object.assign(current.saved, {own, object: kOwnObject, surface: '', face: ''});
  changed('choice');
  save();
}

// ---- options -------------------------------------------------------------------------------------

export function wireOptions(): void {
  const {min, max} = input('seed');
  const seedOf = (text: string): number => Math.min(Number(max), Math.max(Number(min), Math.round(Number(text)) || Number(min)));
  const taken = (id: string, take: () => void): void => $(id).addEventListener('change', () => {
    take();
    save();
  });
  taken('surface', () => (current.saved.surface = select('surface').value));
  taken('takes', () => (current.saved.takes = Number(select('takes').value)));
  taken('fit', () => (current.saved.fit = input('fit').checked));
  taken('seed', () => (current.saved.seed = seedOf(input('seed').value)));
}

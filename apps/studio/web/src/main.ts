// SPDX-License-Identifier: Apache-2.0
// The page: what a person does, and what follows from it.
import * as api from './api';
import {$, button, download, downloadText, showTip, tellError, toast, whileBusy} from './dom';
import {bendColour, contactsOfMarks, explain} from './bend';
import {added, ended, History, labelTrack, mergedWithNext, moved, nextId, removed, split, type Mark, type Marking} from './marks';
import {CurrentJob} from './job';
import {MeshSheet} from './mesh_sheet';
import {fillGrid, pictureOf} from './objects';
import {kMaterials, kOwnObject, massOf, meshKindOf, objectRequest, roundTo3, type OwnObject} from './own';
import {Player} from './player';
import {nearestOnset, Waveform} from './signal';
import {Timeline} from './timeline';
import {recordOrStop} from './record_button';
import {emptySaved, readProject, readSaved, writeProject, type Project, type Saved} from './saved';
import exampleUrl from './example.wav?url';
import type {OrbitControls, Stage, TakeScene} from './stage';

interface Take {
  motion: api.Motion;
  scene: TakeScene | null;
  button: HTMLButtonElement;
  canvas: HTMLCanvasElement;
}

let catalogue: api.CatalogueObject[] = [];
let session: api.Session | null = null;
let wave: Waveform | null = null;
let player: Player | null = null;
let history = new History<Marking>({marks: [], terminal: true});
let chosen: number | null = null;
let saved: Saved = emptySaved();
let takes: Take[] = [];
let stage: Stage | null = null;
let controls: OrbitControls | null = null;
const job = new CurrentJob(() => showPlanButton());

// ---- the sound -----------------------------------------------------------------------------------

/** A sound, a project, or a mesh. */
async function openFile(file: Blob, name: string): Promise<void> {
  if (meshKindOf(name)) return openMesh(file, name);
  await whileBusy(async () => {
    const project = name.endsWith('.ifa-project') ? readProject(await file.text()) : null;
    if (project) await openProject(project);
    else await openSession(await api.sendSound(file, name));
  });
}

async function openProject({name, sound, saved: state, mesh}: Project): Promise<void> {
  const opened = await api.sendSound(new Blob([sound]), name);
  if (mesh && state.own) {
    opened.mesh = await api.sendMesh(opened.session, new Blob([mesh.bytes]), mesh.name, meshKindOf(mesh.name)!);
    await api.makeObject(opened.session, objectRequest(opened.mesh.report, state.own));
  }
  await openSession({...opened, state: {...state, plan: null}});
  save();
  if (state.plan) void animate(); // the same contacts and seed give the same takes
}

async function saveProject(): Promise<void> {
  if (!session) return;
  const sound = new Uint8Array(await (await fetch(api.soundFile(session.session))).arrayBuffer());
  const own = saved.object === kOwnObject ? session.mesh : null;
  const mesh = own && {name: `${own.name || 'mesh'}.${own.kind}`, bytes: await api.sentMesh(session.session)};
  downloadText(`${stem()}.ifa-project`, writeProject({name: session.name, sound, saved: {...saved, marking: history.present}, mesh}));
}

async function openSession(opened: api.Session): Promise<void> {
  const bytes = await (await fetch(api.soundFile(opened.session))).arrayBuffer();
  // An offline context decodes without a person having asked for sound.
  const {rate, duration, contacts} = opened.heard;
  const decoded = await new OfflineAudioContext(1, 1, Math.min(Math.max(rate, 8000), 96000)).decodeAudioData(bytes.slice(0));
  closeSession();
  session = opened;
  wave = new Waveform(decoded.getChannelData(0), decoded.sampleRate);
  player = new Player(bytes, duration);
  // The object is likely the same one, unless it belongs to the session before.
  saved = saved.object === kOwnObject ? emptySaved() : {...emptySaved(), object: saved.object, surface: saved.surface};
  const marks = contacts.map((contact, i) => ({...contact, id: i + 1}));
  history = new History<Marking>({marks, terminal: true});
  const before = readSaved(opened.state);
  if (before) {
    saved = before;
    history = new History<Marking>(saved.marking);
  }
  location.hash = `s=${opened.session}`;
  $('sound-name').textContent = opened.name;
  document.title = `${opened.name || 'Sound'} · Inverse Foley Studio`;
  $('welcome').hidden = true;
  $('editor').hidden = false;
  button('new-sound').hidden = button('save-project').hidden = false;
  timeline.show(wave);
  showChoice();
  showMarks();
  if (history.present.marks.length === 0) toast('No contact was found: double-click where the object touches.');
  if (saved.plan) await showPlan();
}

function closeSession(): void {
  job.cancel();
  player?.close();
  dropTakes();
  chosen = null;
  timeline.setLoop(null);
}

let saveTimer = 0;
function save(): void {
  saved.marking = history.present;
  clearTimeout(saveTimer);
  const id = session?.session;
  if (!id) return;
  saveTimer = window.setTimeout(() => {
    saveTimer = 0;
    api.saveState(id, saved).catch(tellError);
  }, 250);
}

// ---- contacts ------------------------------------------------------------------------------------

const timeline = new Timeline($('track'), {
  choose(id) {
    if (chosen === id) return;
    chosen = id;
    showMarks();
  },
  move(id, start, free) {
    const attack = free || !wave ? null : nearestOnset(wave, start, timeline.reach(7));
    edit(moved(history.present.marks, id, attack ?? start, wave?.duration ?? 0), `drag ${id}`);
  },
  end(id, end) {
    edit(ended(history.present.marks, id, end, wave?.duration ?? 0), `end ${id}`);
  },
  add: addAt,
  seek: (time) => seek(time),
  hover(id, x, y) {
    showTip(id === null ? '' : tipOfMark(id), x, y);
  },
});

function edit(marks: Mark[], key = ''): void {
  history.set({...history.present, marks}, key);
  showMarks();
  save();
}

function addAt(time: number): void {
  const before = history.present.marks;
  const attack = wave ? nearestOnset(wave, time, Math.min(0.01, timeline.reach(10))) : null;
  const marks = added(before, attack ?? time, wave?.duration ?? 0);
  if (marks.length === before.length) return toast('There is a contact already.');
  chosen = nextId(before);
  edit(marks);
  timeline.focusMark(chosen);
}

function chosenMark(): Mark | undefined {
  return history.present.marks.find((mark) => mark.id === chosen);
}

function onChosen(change: (marks: readonly Mark[], mark: Mark) => Mark[], key = ''): void {
  const mark = chosenMark();
  if (!mark) return toast('Choose a contact first: click it, or press Tab.');
  edit(change(history.present.marks, mark), key);
  if (chosenMark()) timeline.focusMark(mark.id);
}

const snapChosen = (): void => onChosen((marks, mark) => {
  const attack = wave ? nearestOnset(wave, mark.start) : null;
  if (attack === null) toast('No attack within 20 ms.');
  return moved(marks, mark.id, attack ?? mark.start, wave?.duration ?? 0);
});
const splitChosen = (): void => onChosen((marks, mark) => split(marks, mark.id, player?.position ?? 0));
const mergeChosen = (): void => onChosen((marks, mark) => mergedWithNext(marks, mark.id));
const deleteChosen = (): void => onChosen((marks, mark) => {
  const at = marks.indexOf(mark);
  chosen = (marks[at + 1] ?? marks[at - 1])?.id ?? null;
  return removed(marks, mark.id);
});

function setTerminal(terminal: boolean): void {
  history.set({...history.present, terminal});
  showMarks();
  save();
}

function step(change: 'undo' | 'redo'): void {
  history[change]();
  showMarks();
  save();
}

/** Whether the takes were made for other contacts than there are now. */
function stale(): boolean {
  if (!saved.plan) return false;
  const times = (marks: readonly Mark[]): string => marks.map((mark) => `${mark.start} ${mark.end}`).join();
  return times(saved.plan.marks) !== times(history.present.marks);
}

function showMarks(): void {
  const {marks, terminal} = history.present;
  const tones = new Map<number, string>();
  const motion = takes[saved.take - 1]?.motion;
  if (motion && !stale()) {
    for (const [id, i] of contactsOfMarks(marks, motion)) {
      tones.set(id, bendColour(motion.contacts[i]!.bend / motion.bend.cap));
    }
  }
  timeline.setMarks(history.present, chosen, tones);
  $<HTMLInputElement>('terminal').checked = terminal;
  button('undo').disabled = !history.canUndo;
  button('redo').disabled = !history.canRedo;
  const mark = chosenMark();
  const at = mark ? marks.indexOf(mark) : -1;
  for (const id of ['snap', 'delete']) button(id).disabled = !mark;
  button('split').disabled = !mark || mark.end <= mark.start;
  button('merge').disabled = !mark || at + 1 === marks.length;
  $('mark-info').textContent = mark
    ? `${at + 1}: ${mark.start.toFixed(4)} s${mark.end > mark.start ? ` – ${mark.end.toFixed(3)} s` : ''}`
    : `${marks.length} contact${marks.length === 1 ? '' : 's'}`;
  showPlanButton();
}

function tipOfMark(id: number): string {
  const {marks} = history.present;
  const at = marks.findIndex((mark) => mark.id === id);
  const mark = marks[at];
  if (!mark) return '';
  const motion = takes[saved.take - 1]?.motion;
  const contact = motion && !stale() ? contactsOfMarks(marks, motion).get(id) : undefined;
  if (motion && contact !== undefined) return explain(motion.contacts[contact]!, at, motion.bend.cap, mark.start);
  const sure = mark.confidence < 1 ? `\n${Math.round(100 * mark.confidence)} % sure that something touches here` : '';
  return `Contact ${at + 1} at ${mark.start.toFixed(4)} s${sure}`;
}

// ---- labels --------------------------------------------------------------------------------------

const stem = (): string => (session?.name || 'sound').replace(/\.[^.]*$/, '');

const saveLabels = (): void => downloadText(`${stem()}.txt`, labelTrack(history.present));

async function loadLabels(file: Blob): Promise<void> {
  try {
    const {marks, terminal} = await api.readLabels(await file.text());
    const sorted = [...marks].sort((a, b) => a.start - b.start);
    history.set({marks: sorted.map((mark, i) => ({...mark, id: i + 1, confidence: 1})), terminal});
    chosen = null;
    showMarks();
    save();
  } catch (error) {
    tellError(error);
  }
}

// ---- playing -------------------------------------------------------------------------------------

function seek(time: number): void {
  player?.seek(time);
}

async function togglePlay(): Promise<void> {
  if (!player) return;
  if (player.playing) player.pause();
  else await player.play().catch(tellError);
  const on = player.playing;
  button('play').classList.toggle('on', on);
  button('play').setAttribute('aria-label', on ? 'Pause' : 'Play');
}

async function toggleLoop(): Promise<void> {
  if (!player) return;
  const on = !player.loops;
  const {marks} = history.present;
  const at = chosenMark()?.start ?? player.position;
  const before = marks.filter((mark) => mark.start <= at + 1e-6).pop();
  const after = marks.find((mark) => mark.start > at + 1e-6);
  const span = {from: Math.max(0, (before?.start ?? 0) - 0.03), to: Math.min(player.duration, (after?.start ?? player.duration) + 0.03)};
  await player.setSpan(on ? span : null);
  timeline.setLoop(on && player.loops ? player.span : null);
  button('loop').setAttribute('aria-pressed', String(player.loops));
}

let turn = 0;
let drawn = '';
let drawnStill = false;
let lastMoved = 0;
const idleStart = performance.now();
function frame(): void {
  requestAnimationFrame(frame);
  if (!player || $('editor').hidden) return;
  const time = player.position;
  timeline.setPosition(time);
  $('clock').textContent = `${time.toFixed(3)} s`;
  const take = takes[saved.take - 1];
  if (!take?.scene || !stage) return;
  ++turn;
  // While something is planned, the processor is the planner's.
  const small = !job.runs && turn % 4 === 0 && drawSmall(time);
  take.scene.setTime(time, controls ?? undefined);
  controls?.update();
  const now = `${saved.plan?.number} ${saved.take} ${time} ${take.scene.camera.position.toArray()} ${innerWidth} ${innerHeight} ${theme}`;
  if (now !== drawn) lastMoved = performance.now();
  const still = performance.now() - lastMoved > 250;
  if (now === drawn && still === drawnStill && !small) return;
  drawn = now;
  drawnStill = still;
  stage.drawLarge(take.scene, still);
}

/** One of the small pictures at a time: they may come late, the large one may not. Whether one was drawn. */
function drawSmall(time: number): boolean {
  const take = takes[(turn / 4) % takes.length];
  if (!take?.scene || !stage || !player) return false;
  const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
  take.scene.setTime(player.playing || still ? time : ((performance.now() - idleStart) / 1000) % (player.duration + 0.4));
  stage.drawSmall(take.scene, take.canvas);
  return true;
}

// ---- what fell, and how --------------------------------------------------------------------------

function chosenObject(): api.CatalogueObject | undefined {
  if (saved.object !== kOwnObject) return catalogue.find((one) => one.name === saved.object);
  const {own} = saved;
  if (!own || !session?.mesh) return undefined;
  const material = `${kMaterials[own.material]!.name}, ${roundTo3(massOf(session.mesh.report, own))} g`;
  return {name: kOwnObject, title: own.name, material, surface: 'desk', surfaces: ['desk'], faces: {}};
}

// ---- an object of one's own ----------------------------------------------------------------------

const sheet = new MeshSheet(useOwn, () => $('mesh-file').click());

async function openMesh(file: Blob, name: string): Promise<void> {
  const opened = session;
  const kind = meshKindOf(name);
  if (!opened) return toast('First the sound, then the object that made it.');
  if (!kind) return toast('A mesh is wanted: OBJ, STL, PLY, OFF or GLB.');
  await whileBusy(async () => {
    opened.mesh = await api.sendMesh(opened.session, file, name, kind);
    if (session !== opened) return;
    // The one before is no more.
    saved.own = null;
    if (saved.object === kOwnObject) saved.object = '';
    $<HTMLDialogElement>('objects').close();
    showChoice();
    save();
    sheet.open(opened.session, opened.mesh, null);
  });
}

/** What was said of the session's mesh; where it has none, to choose one. */
function openOwn(): void {
  if (!session?.mesh) return $('mesh-file').click();
  $<HTMLDialogElement>('objects').close();
  sheet.open(session.session, session.mesh, saved.own);
}

function useOwn(own: OwnObject): void {
  Object.assign(saved, {own, object: kOwnObject, surface: '', face: ''});
  showChoice();
  save();
}


const facesOf = (object: api.CatalogueObject | undefined): string[] =>
  Object.keys(object?.faces ?? {}).sort((a, b) => a.localeCompare(b, 'en', {numeric: true}));

function showChoice(): void {
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
  const surface = $<HTMLSelectElement>('surface');
  surface.replaceChildren(...(object?.surfaces ?? []).map((name) => new Option(name, name)));
  surface.value = saved.surface || object?.surface || '';
  $('surface-row').hidden = (object?.surfaces.length ?? 0) < 2;
  $<HTMLSelectElement>('takes').value = String(saved.takes);
  $<HTMLInputElement>('fit').checked = saved.fit;
  $<HTMLInputElement>('seed').value = String(saved.seed);
  showPlanButton();
}

function demandFace(face: string): void {
  if (face === saved.face) return;
  saved.face = face;
  showChoice();
  save();
  if (saved.plan) void animate(); // asked again of what is there: planned at once
}

function faceChip(face: string): HTMLElement {
  const chip = document.createElement('button');
  chip.textContent = face || 'any';
  chip.setAttribute('role', 'radio');
  chip.setAttribute('aria-checked', String(face === saved.face));
  chip.setAttribute('aria-label', face ? `${face} up` : 'any face up');
  chip.addEventListener('click', () => demandFace(face));
  return chip;
}

function chooseObject(name: string): void {
  if (name !== saved.object) Object.assign(saved, {object: name, surface: '', face: ''});
  $<HTMLDialogElement>('objects').close();
  showChoice();
  save();
}

function showPlanButton(): void {
  const plan = button('plan');
  plan.disabled = !chosenObject() || history.present.marks.length === 0;
  plan.textContent = job.runs ? 'Cancel' : stale() ? 'Animate again' : 'Animate';
  if (job.runs) plan.disabled = false;
}

async function animate(): Promise<void> {
  const id = session?.session;
  const {marks, terminal} = history.present;
  if (!id) return;
  if (!chosenObject()) return openObjects();
  if (marks.length === 0) return;
  const request: api.PlanRequest = {
    marks: marks.map(({start, end, confidence}) => ({start, end, weight: confidence >= 0.9 ? 1 : Math.max(0.01, confidence)})),
    terminal, object: saved.object, surface: saved.surface, face: saved.face, fit: saved.fit, takes: saved.takes, seed: saved.seed,
  };
  const started = performance.now();
  const result = await job.run((signal, tell) => api.plan(id, request, tell, signal));
  if (!result) return;
  const failure = result.failure ? [result.failure.message, result.failure.remedy].filter(Boolean).join(' — ') : '';
  saved.plan = {number: result.plan, takes: result.takes, marks, failure};
  saved.take = 1;
  await showPlan();
  save();
  performance.measure('edit to takes', {start: started, end: performance.now()});
  if (player && !player.playing && !failure) {
    player.seek(0);
    await togglePlay();
  }
}

// ---- takes ---------------------------------------------------------------------------------------

function dropTakes(): void {
  for (const take of takes) take.scene?.dispose();
  takes = [];
  $('takes-list').replaceChildren();
  for (const id of ['verdict', 'exports', 'legend']) $(id).hidden = true;
  $('empty').hidden = false;
  $('large').hidden = true;
}

function takeButton(number: number): {button: HTMLButtonElement; canvas: HTMLCanvasElement} {
  const element = document.createElement('button');
  element.className = 'take';
  element.setAttribute('role', 'radio');
  const canvas = document.createElement('canvas');
  const name = document.createElement('span');
  element.append(canvas, name);
  element.addEventListener('click', () => chooseTake(number));
  return {button: element, canvas};
}

/** Loads three.js with the first plan, so that the page itself is there at once. */
async function theStage(): Promise<Stage> {
  const module = await import('./stage');
  if (stage) return stage;
  stage = new module.Stage($<HTMLCanvasElement>('large'));
  if (!stage.works) toast('This browser draws no 3D (WebGL); films and files can be had all the same.');
  return stage;
}

async function showPlan(): Promise<void> {
  const id = session?.session;
  const plan = saved.plan;
  if (!id || !plan) return;
  try {
    const [drawing, motions, bodies] = await Promise.all([
      theStage(),
      Promise.all(Array.from({length: plan.takes}, (_, i) => api.motion(id, plan.number, i + 1))),
      Promise.all(Array.from({length: plan.takes}, async (_, i) => (await fetch(api.takeFile(id, plan.number, i + 1, 'motion.glb'))).arrayBuffer())),
    ]);
    dropTakes();
    const first = plan.marks[0]?.start ?? 0;
    for (const [i, motion] of motions.entries()) {
      const scene = drawing.works ? await drawing.load(bodies[i]!, motion, first) : null;
      takes.push({motion, scene, ...takeButton(i + 1)});
    }
  } catch (error) {
    saved.plan = null;
    return tellError(error);
  }
  takes.forEach(({button: element, motion}, i) => {
    element.querySelector('span')!.textContent = `Take ${i + 1} · ${motion.success ? motion.score.toFixed(2) : 'partial'}`;
    element.setAttribute('aria-label', `Take ${i + 1}, ${motion.success ? `score ${motion.score.toFixed(2)}` : 'partial'}`);
    $('takes-list').append(element);
  });
  $('empty').hidden = true;
  $('large').hidden = !stage?.works;
  drawn = '';
  paintTakes();
  chooseTake(Math.min(saved.take, takes.length));
}

let theme = '';
function paintTakes(): void {
  const style = getComputedStyle(document.documentElement);
  theme = style.getPropertyValue('--paper').trim();
  for (const {scene, motion} of takes) {
    scene?.setTheme(theme, style.getPropertyValue('--line').trim());
    scene?.setSpots(motion.contacts.map((contact) => ({
      position: contact.position, colour: bendColour(contact.bend / motion.bend.cap),
    })));
  }
}

function chooseTake(number: number): void {
  const take = takes[number - 1];
  if (!take || !saved.plan || !session) return;
  saved.take = number;
  takes.forEach(({button: element}, i) => {
    element.setAttribute('aria-checked', String(i + 1 === number));
    element.tabIndex = i + 1 === number ? 0 : -1;
  });
  const {motion} = take;
  const met = motion.contacts.length;
  $('verdict').hidden = false;
  $('verdict').textContent = motion.success
    ? `${met} contact${met === 1 ? '' : 's'} met · score ${motion.score.toFixed(2)}`
    : `Not all contacts are met: ${saved.plan.failure || motion.failure || ''}`;
  $('legend').hidden = $('exports').hidden = false;
  for (const link of $('exports').querySelectorAll('a')) {
    const file = link.dataset['file']!;
    link.href = api.takeFile(session.session, saved.plan.number, number, file);
    link.download = `${stem()}-take-${number}${file.slice(file.lastIndexOf('.'))}`;
  }
  const camera = take.scene;
  controls?.dispose();
  controls = null;
  if (camera) void import('./stage').then(({OrbitControls: Controls}) => {
    if (takes[saved.take - 1] !== take) return;
    controls = new Controls(camera.camera, $('large'));
    controls.target.copy(camera.target);
    controls.enablePan = false;
    controls.maxPolarAngle = 1.54;
  });
  showMarks();
  save();
}

async function exportFilm(final: boolean): Promise<void> {
  const id = session?.session;
  const plan = saved.plan;
  if (!id || !plan) return;
  const take = saved.take;
  await job.run(async (signal, tell) => {
    await api.film(id, plan.number, take, final, tell, signal);
    download(`${stem()}-take-${take}.mp4`, api.takeFile(id, plan.number, take, 'film.mp4'));
  });
}

// ---- wiring --------------------------------------------------------------------------------------

function openObjects(): void {
  $<HTMLDialogElement>('objects').showModal();
  $('object-search').focus();
}

const typing = (target: EventTarget | null): boolean =>
  target instanceof HTMLInputElement && target.type !== 'checkbox' || target instanceof HTMLSelectElement;

function arrow(direction: number, coarse: boolean): void {
  const stepBy = direction * (coarse ? 0.01 : 0.001);
  if (chosenMark()) onChosen((marks, mark) => moved(marks, mark.id, mark.start + stepBy, wave?.duration ?? 0), `nudge ${chosen}`);
  else seek((player?.position ?? 0) + stepBy);
}

const keys: Record<string, (event: KeyboardEvent) => void> = {
  ' ': () => void togglePlay(),
  ArrowLeft: (event) => arrow(-1, event.shiftKey),
  ArrowRight: (event) => arrow(1, event.shiftKey),
  a: () => addAt(player?.position ?? 0),
  o: snapChosen, s: splitChosen, m: mergeChosen, Delete: deleteChosen, Backspace: deleteChosen,
  t: () => setTerminal(!history.present.terminal),
  l: () => void toggleLoop(),
  '+': () => timeline.zoom(0.6, player?.position), '=': () => timeline.zoom(0.6, player?.position),
  '-': () => timeline.zoom(1.7, player?.position), '0': () => timeline.showAll(),
  Escape: () => (chosen = null, showMarks()),
  '?': () => $<HTMLDialogElement>('keys').showModal(),
};

function keyDown(event: KeyboardEvent): void {
  if (typing(event.target) || document.querySelector('dialog[open]') || $('editor').hidden) return;
  const command = event.ctrlKey || event.metaKey;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (command && key === 'z') step(event.shiftKey ? 'redo' : 'undo');
  else if (command && key === 'y') step('redo');
  else if (command && key === 'Enter') void animate();
  else if (command || event.altKey) return;
  else if (key >= '1' && key <= '6' && key.length === 1) chooseTake(Number(key));
  else if (keys[key] && !(key === ' ' && event.target instanceof HTMLButtonElement && event.target.id !== 'play')) keys[key](event);
  else return;
  event.preventDefault();
}

function wire(): void {
  const on = (id: string, action: () => void): void => $(id).addEventListener('click', action);
  on('choose-sound', () => $('sound-file').click());
  on('new-sound', () => {
    closeSession();
    player = null;
    session = null;
    window.history.replaceState(null, '', location.pathname);
    $('editor').hidden = button('new-sound').hidden = button('save-project').hidden = true;
    $('welcome').hidden = false;
    $('sound-name').textContent = '';
  });
  on('example', () => void fetch(exampleUrl).then((answer) => answer.blob()).then((blob) => openFile(blob, 'example.wav')).catch(tellError));
  on('record', () => void recordOrStop((sound) => openFile(sound, 'recording.wav')));
  on('save-project', () => void saveProject().catch(tellError));
  on('play', () => void togglePlay());
  on('loop', () => void toggleLoop());
  on('undo', () => step('undo'));
  on('redo', () => step('redo'));
  on('add', () => addAt(player?.position ?? 0));
  on('snap', snapChosen);
  on('split', splitChosen);
  on('merge', mergeChosen);
  on('delete', deleteChosen);
  on('zoom-in', () => timeline.zoom(0.6, player?.position));
  on('zoom-out', () => timeline.zoom(1.7, player?.position));
  on('labels-in', () => $('labels-file').click());
  on('labels-out', saveLabels);
  on('object', openObjects);
  on('own-mesh', openOwn);
  on('own-change', openOwn);
  on('plan', () => (job.runs ? job.cancel() : void animate()));
  on('export-film', () => void exportFilm(false));
  on('export-hd', () => void exportFilm(true));
  on('help', () => $<HTMLDialogElement>('keys').showModal());
  document.querySelectorAll('[data-close]').forEach((one) => one.addEventListener('click', () => one.closest('dialog')!.close()));
  $('terminal').addEventListener('change', () => setTerminal($<HTMLInputElement>('terminal').checked));
  $('speed').addEventListener('change', () => void player?.setSpeed(Number($<HTMLSelectElement>('speed').value)));
  wireOptions();
  wireFiles();
  wirePictures();
  document.addEventListener('keydown', keyDown);
}

function wireOptions(): void {
  const changed = (id: string, take: () => void): void => $(id).addEventListener('change', () => {
    take();
    save();
  });
  changed('surface', () => (saved.surface = $<HTMLSelectElement>('surface').value));
  changed('takes', () => (saved.takes = Number($<HTMLSelectElement>('takes').value)));
  changed('fit', () => (saved.fit = $<HTMLInputElement>('fit').checked));
  changed('seed', () => (saved.seed = Math.min(999999, Math.max(1, Math.round(Number($<HTMLInputElement>('seed').value)) || 1))));
}

function wireFiles(): void {
  const picked = (id: string, use: (file: File) => Promise<void>): void => $(id).addEventListener('change', () => {
    const input = $<HTMLInputElement>(id);
    const file = input.files?.[0];
    input.value = '';
    if (file) void use(file);
  });
  picked('sound-file', (file) => openFile(file, file.name));
  picked('labels-file', loadLabels);
  picked('mesh-file', (file) => openMesh(file, file.name));
  document.addEventListener('dragover', (event) => {
    event.preventDefault();
    document.body.classList.add('dropping');
  });
  document.addEventListener('dragleave', (event) => {
    if (event.relatedTarget === null) document.body.classList.remove('dropping');
  });
  document.addEventListener('drop', (event) => {
    event.preventDefault();
    document.body.classList.remove('dropping');
    const file = event.dataTransfer?.files[0];
    if (!file) return;
    const labels = file.name.toLowerCase().endsWith('.txt') && session;
    void (labels ? loadLabels(file) : openFile(file, file.name));
  });
}

/** The named face of the body at that place of the large picture; none where that has no name, or the takes are of another object. */
function faceAt([x, y]: [number, number]): string | null {
  const take = takes[saved.take - 1];
  if (!take || take.motion.object.name !== saved.object) return null;
  const normal = take.scene?.normalAt(x, y);
  if (!normal) return null;
  const faces = Object.entries(chosenObject()?.faces ?? {});
  return faces.find(([, to]) => to[0] * normal[0] + to[1] * normal[1] + to[2] * normal[2] > 0.95)?.[0] ?? null;
}

function tipOfPlace(place: [number, number]): string {
  const take = takes[saved.take - 1];
  const spot = take?.scene?.spotAt(...place) ?? null;
  const contact = spot === null ? undefined : take?.motion.contacts[spot];
  const first = saved.plan?.marks[0]?.start ?? 0;
  if (take && contact && spot !== null) return explain(contact, spot, take.motion.bend.cap, first + contact.time);
  const face = job.runs ? null : faceAt(place);
  return face === null || face === saved.face ? '' : `Click: ends with ${face} up`;
}

function wirePictures(): void {
  const large = $<HTMLCanvasElement>('large');
  const placeOf = (event: PointerEvent): [number, number] => {
    const box = large.getBoundingClientRect();
    return [(2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height];
  };
  large.addEventListener('pointermove', (event) => showTip(tipOfPlace(placeOf(event)), event.clientX, event.clientY));
  let down: [number, number] = [0, 0];
  large.addEventListener('pointerdown', (event) => (down = [event.clientX, event.clientY]));
  large.addEventListener('pointerup', (event) => {
    const turned = Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4;
    const face = turned ? null : faceAt(placeOf(event));
    if (face !== null) demandFace(face);
  });
  large.addEventListener('pointerleave', () => showTip('', 0, 0));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', paintTakes);
  $('takes-list').addEventListener('keydown', (event) => {
    const move = {ArrowDown: 1, ArrowUp: -1}[event.key];
    if (!move || takes.length === 0) return;
    event.preventDefault();
    chooseTake(((saved.take - 1 + move + takes.length) % takes.length) + 1);
    takes[saved.take - 1]?.button.focus();
  });
}

async function start(): Promise<void> {
  wire();
  requestAnimationFrame(frame);
  const id = /^#s=([0-9a-f]{32})$/.exec(location.hash)?.[1];
  try {
    const [list, before] = await Promise.all([api.objects(), id ? api.session(id) : null]);
    // Dice first: what most sounds here are of.
    const isDie = ({name}: api.CatalogueObject): boolean => /^d\d+$/.test(name);
    catalogue = [...list.filter(isDie).sort((a, b) => facesOf(a).length - facesOf(b).length), ...list.filter((one) => !isDie(one))];
    fillGrid($('object-grid'), $<HTMLInputElement>('object-search'), catalogue, chooseObject);
    if (before) await openSession(before);
  } catch (error) {
    tellError(error);
  }
}

// For measuring: what is drawn, and what is heard.
Object.assign(window, {
  studio: {
    get time(): number { return player?.position ?? 0; },
    get contacts(): number[] { return takes[saved.take - 1]?.motion.contacts.map((c) => (saved.plan?.marks[0]?.start ?? 0) + c.time) ?? []; },
    lowestAt(time: number): number {
      const scene = takes[saved.take - 1]?.scene;
      scene?.setTime(time);
      return scene?.lowestPoint() ?? NaN;
    },
  },
});

void start();

// SPDX-License-Identifier: Apache-2.0
// The takes of a plan side by side, and which of them is seen large.
import * as api from './api';
import {bendColour} from './bend';
import {changed, chosenTake, current, save, stem} from './current';
import {$, download, tellError, toast} from './dom';
import {job} from './job';
import type {OrbitControls, Stage} from './stage';

/** What draws; null until there is something to draw, so that the page itself is there at once. */
export let stage: Stage | null = null;
/** Of the large view's camera. */
export let controls: OrbitControls | null = null;
/** The colour of the ground: what is drawn depends on it. */
export let theme = '';

async function theStage(): Promise<Stage> {
  const module = await import('./stage');
  if (stage) return stage;
  stage = new module.Stage($<HTMLCanvasElement>('large'));
  if (!stage.works) toast('This browser draws no 3D (WebGL); films and files can be had all the same.');
  return stage;
}

export function dropTakes(): void {
  for (const take of current.takes) take.scene?.dispose();
  current.takes = [];
  $('takes-list').replaceChildren();
  for (const id of ['verdict', 'exports', 'legend', 'large']) $(id).hidden = true;
  $('empty').hidden = false;
  changed('takes');
}

function takeButton(number: number, motion: api.Motion): {button: HTMLButtonElement; canvas: HTMLCanvasElement} {
  const element = document.createElement('button');
  element.className = 'take';
  element.setAttribute('role', 'radio');
  element.setAttribute('aria-label', `Take ${number}, ${motion.success ? `score ${motion.score.toFixed(2)}` : 'partial'}`);
  const canvas = document.createElement('canvas');
  const name = document.createElement('span');
  name.textContent = `Take ${number} · ${motion.success ? motion.score.toFixed(2) : 'partial'}`;
  element.append(canvas, name);
  element.addEventListener('click', () => chooseTake(number));
  return {button: element, canvas};
}

/** Loads the takes of the plan that is saved, and shows them. */
export async function showPlan(): Promise<void> {
  const id = current.session?.session;
  const {saved} = current;
  const {plan} = saved;
  if (!id || !plan) return;
  try {
    const numbers = Array.from({length: plan.takes}, (_, i) => i + 1);
    const [drawing, motions, bodies] = await Promise.all([
      theStage(),
      Promise.all(numbers.map((number) => api.motion(id, plan.number, number))),
      Promise.all(numbers.map((number) => api.animation(id, plan.number, number))),
    ]);
    const before = chosenTake();
    const view = before?.motion.object.name === motions[0]?.object.name ? before?.scene?.view() : undefined;
    dropTakes();
    const first = plan.marks[0]?.start ?? 0;
    for (const [i, motion] of motions.entries()) {
      const scene = drawing.works ? await drawing.load(bodies[i]!, motion, first) : null;
      if (view) scene?.lookFrom(view);
      current.takes.push({motion, scene, ...takeButton(i + 1, motion)});
    }
  } catch (error) {
    saved.plan = null;
    return tellError(error);
  }
  $('takes-list').append(...current.takes.map(({button}) => button));
  $('empty').hidden = true;
  $('large').hidden = !stage?.works;
  paintTakes();
  chooseTake(Math.min(saved.take, current.takes.length));
}

/** In the colours of the page. */
export function paintTakes(): void {
  const style = getComputedStyle(document.documentElement);
  theme = style.getPropertyValue('--paper').trim();
  const [line, accent] = ['--line', '--accent'].map((name) => style.getPropertyValue(name).trim());
  for (const {scene, motion} of current.takes) {
    scene?.setTheme(theme, line!, accent!);
    scene?.setSpots(motion.contacts.map((contact) => ({
      position: contact.position, colour: bendColour(contact.bend / motion.bend.cap),
    })));
  }
}

export function chooseTake(number: number): void {
  const {takes, saved, session} = current;
  const take = takes[number - 1];
  if (!take || !saved.plan || !session) return;
  saved.take = number;
  takes.forEach(({button}, i) => {
    button.setAttribute('aria-checked', String(i + 1 === number));
    button.tabIndex = i + 1 === number ? 0 : -1;
  });
  const {motion, scene} = take;
  const met = motion.contacts.length;
  $('verdict').textContent = motion.success
    ? `${met} contact${met === 1 ? '' : 's'} met · score ${motion.score.toFixed(2)}`
    : `Not all contacts are met: ${saved.plan.failure || motion.failure || ''}`;
  for (const id of ['verdict', 'legend', 'exports']) $(id).hidden = false;
  for (const link of $('exports').querySelectorAll('a')) {
    const file = link.dataset['file']!;
    link.href = api.takeFile(session.session, saved.plan.number, number, file);
    link.download = `${stem()}-take-${number}${file.slice(file.lastIndexOf('.'))}`;
  }
  controls?.dispose();
  controls = scene && stage ? stage.controlsOf(scene) : null;
  changed('takes');
  save();
}

export function chooseNextTake(by: number): void {
  const {takes, saved} = current;
  if (takes.length === 0) return;
  chooseTake(((saved.take - 1 + by + takes.length) % takes.length) + 1);
  chosenTake()?.button.focus();
}

/** @param final for showing, rather than a draft */
export async function exportFilm(final: boolean): Promise<void> {
  const id = current.session?.session;
  const {plan, take} = current.saved;
  if (!id || !plan) return;
  await job.run(async (signal, tell) => {
    await api.film(id, plan.number, take, final, tell, signal);
    download(`${stem()}-take-${take}.mp4`, api.takeFile(id, plan.number, take, 'film.mp4'));
  });
}

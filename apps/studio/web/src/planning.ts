// SPDX-License-Identifier: Apache-2.0
// From marks, object and wishes to takes; what is wished for.
import * as api from './api';
import {changed, chosenObject, current, save, stale, whenChanged} from './current';
import {button} from './dom';
import {job} from './job';
import {openObjects} from './objects';
import {chooseTake, showPlan} from './takes';
import {togglePlay} from './transport';

whenChanged(['marks', 'choice', 'takes', 'job'], () => {
  const plan = button('plan');
  plan.disabled = !job.runs && (!chosenObject() || current.history.present.marks.length === 0);
  plan.textContent = job.runs ? 'Cancel' : stale() ? 'Animate again' : 'Animate';
});

function requestOf(): api.PlanRequest {
  const {saved, history} = current;
  const {marks, terminal} = history.present;
  const landing = saved.landing && marks.length > 1 ? {x: saved.landing[0], y: saved.landing[1]} : null;
  return {
    marks: marks.map(({start, end, confidence}) => ({start, end, weight: confidence >= 0.9 ? 1 : Math.max(0.01, confidence)})),
    terminal, object: saved.object, surface: saved.surface, face: saved.face, landing, fit: saved.fit, takes: saved.takes, seed: saved.seed,
  };
}

/** The number of the take that lands nearest to where it was asked to; the first where nothing was asked. */
function nearestTake(landing: api.PlanRequest['landing']): number {
  if (!landing) return 1;
  const offs = current.takes.map(({motion}) => {
    const [first, last] = [motion.contacts[0]?.position, motion.contacts.at(-1)?.position];
    return first && last && motion.success ? Math.hypot(last[0] - first[0] - landing.x, last[1] - first[1] - landing.y) : Infinity;
  });
  return offs.indexOf(Math.min(...offs)) + 1;
}

export async function animate(): Promise<void> {
  const {marks} = current.history.present;
  const id = current.session?.session;
  if (!id) return;
  if (!chosenObject()) return openObjects();
  if (marks.length === 0) return;
  const request = requestOf();
  const started = performance.now();
  const result = await job.run((signal, tell) => api.plan(id, request, tell, signal));
  if (!result) return;
  const failure = result.failure ? [result.failure.message, result.failure.remedy].filter(Boolean).join(' — ') : '';
  Object.assign(current.saved, {plan: {number: result.plan, takes: result.takes, marks, failure}, take: 1});
  await showPlan();
  chooseTake(nearestTake(request.landing));
  performance.measure('edit to takes', {start: started, end: performance.now()});
  if (current.player && !current.player.playing && !failure) {
    current.player.seek(0);
    await togglePlay();
  }
}

/** Another wish; asked of what is there, it is planned at once. */
function wish(change: () => void): void {
  change();
  changed('choice');
  save();
  if (current.saved.plan) void animate();
}

/** @param face to lie on top at the end; empty: any */
export function demandFace(face: string): void {
  if (face !== current.saved.face) wish(() => (current.saved.face = face));
}

/** @param landing of the last contact, m from the first; null: anywhere */
export function demandLanding(landing: [number, number] | null): void {
  wish(() => (current.saved.landing = landing));
}

// SPDX-License-Identifier: Apache-2.0
// A sound and all that was done to it: opened, closed, as a project file.
import * as api from './api';
import {timeline} from './contacts';
import {changed, current, save, stem} from './current';
import {$, button, downloadText, toast, whileBusy} from './dom';
import {job} from './job';
import {History, type Marking} from './marks';
import {openMesh} from './choice';
import {kOwnObject, meshKindOf, objectRequest} from './own';
import {animate} from './planning';
import {Player} from './player';
import {emptySaved, readProject, readSaved, writeProject, type Project} from './saved';
import {Waveform} from './signal';
import {dropTakes, showPlan} from './takes';
import {pause, setSpeed} from './transport';

/** A sound, a project, or a mesh. */
export async function openFile(file: Blob, name: string): Promise<void> {
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

export async function saveProject(): Promise<void> {
  const {session, saved, history} = current;
  if (!session) return;
  const sound = new Uint8Array(await api.sound(session.session));
  const own = saved.object === kOwnObject ? session.mesh : null;
  const mesh = own && {name: `${own.name || 'mesh'}.${own.kind}`, bytes: await api.sentMesh(session.session)};
  downloadText(`${stem()}.ifa-project`, writeProject({name: session.name, sound, saved: {...saved, marking: history.present}, mesh}));
}

export async function openSession(opened: api.Session): Promise<void> {
  const bytes = await api.sound(opened.session);
  // An offline context decodes without a person having asked for sound.
  const {rate, duration, contacts} = opened.heard;
  const decoded = await new OfflineAudioContext(1, 1, Math.min(Math.max(rate, 8000), 96000)).decodeAudioData(bytes.slice(0));
  closeSession();
  current.session = opened;
  current.wave = new Waveform(decoded.getChannelData(0), decoded.sampleRate);
  current.player = new Player(bytes, duration);
  void setSpeed();
  // The object is likely the same one, unless it belongs to the session before.
  const {object, surface} = current.saved;
  const fresh = object === kOwnObject ? emptySaved() : {...emptySaved(), object, surface};
  const marks = contacts.map((contact, i) => ({...contact, id: i + 1}));
  current.saved = readSaved(opened.state) ?? {...fresh, marking: {marks, terminal: true}};
  current.history = new History<Marking>(current.saved.marking);
  location.hash = `s=${opened.session}`;
  showOpen(opened.name || 'Sound');
  timeline.show(current.wave);
  for (const topic of ['choice', 'marks', 'loop'] as const) changed(topic);
  if (current.history.present.marks.length === 0) toast('No contact was found: double-click where the object touches.');
  if (current.saved.plan) await showPlan();
}

/** @param name of what is open; null: nothing */
function showOpen(name: string | null): void {
  $('sound-name').textContent = name ?? '';
  document.title = name === null ? 'Inverse Foley Studio' : `${name} · Inverse Foley Studio`;
  $('welcome').hidden = name !== null;
  $('editor').hidden = button('new-sound').hidden = button('save-project').hidden = name === null;
}

function closeSession(): void {
  job.cancel();
  pause();
  current.player?.close();
  current.player = null;
  current.session = null;
  current.chosen = null;
  dropTakes();
}

/** Back to the first page. */
export function leave(): void {
  closeSession();
  window.history.replaceState(null, '', location.pathname);
  showOpen(null);
}

// SPDX-License-Identifier: Apache-2.0
// What the studio's server is asked, and what it tells.
import type {OwnMesh} from './own';

export interface CatalogueObject {
  name: string;
  title: string;
  material: string;
  surface: string;
  surfaces: string[];
  /** Unit directions in the body's frame, z up where it was drawn. */
  faces: Record<string, [number, number, number]>;
}

export interface Heard {
  rate: number;
  duration: number;
  contacts: {start: number; end: number; confidence: number}[];
}

export interface Session {
  session: string;
  name: string;
  heard: Heard;
  mesh: OwnMesh | null;
  state: unknown;
}

export interface MotionContact {
  target_time: number;
  time: number;
  duration: number;
  bend: number;
  arrival: string;
  factors: Record<string, number>;
  position: [number, number, number];
}

export interface Motion {
  success: boolean;
  failure: string | null;
  score: number;
  bend: {median: number; max: number; cap: number};
  object: {name: string; surface: string; restitution: number};
  sound: {first_contact: number; duration: number};
  contacts: MotionContact[];
  trajectory: {time: number[]; position: [number, number, number][]};
}

export interface PlanRequest {
  marks: {start: number; end: number; weight: number}[];
  terminal: boolean;
  object: string;
  surface: string;
  face: string;
  /** Of the last contact, m from the first. */
  landing: {x: number; y: number} | null;
  fit: boolean;
  takes: number;
  seed: number;
}

export interface PlanResult {
  plan: number;
  takes: number;
  failure: {message: string; remedy: string} | null;
}

/** An answer that is a refusal: what is wrong, and what to do about it. */
export class StudioError extends Error {
  constructor(message: string, readonly remedy: string) {
    super(message);
  }
}

async function checked(response: Response): Promise<Response> {
  if (response.ok) return response;
  const told = (await response.json().catch(() => null)) as {message?: string; remedy?: string} | null;
  throw new StudioError(told?.message ?? `the studio answered ${response.status}`, told?.remedy ?? '');
}

async function ask(path: string, init?: RequestInit): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(path, init);
  } catch (error) {
    if (error instanceof DOMException && error.name === 'AbortError') throw error;
    throw new StudioError('the studio does not answer', 'is ifa studio still running?');
  }
  return checked(response);
}

const json = (body: unknown): RequestInit => ({
  method: 'POST',
  headers: {'Content-Type': 'application/json'},
  body: JSON.stringify(body),
});

export const takeFile = (session: string, plan: number, take: number, file: string): string =>
  `/api/sessions/${session}/plans/${plan}/takes/${take}/${file}`;

export async function objects(): Promise<CatalogueObject[]> {
  return (await ask('/api/objects')).json() as Promise<CatalogueObject[]>;
}

export async function sendSound(file: Blob, name: string): Promise<Session> {
  if (file.size > 64 << 20) {
    throw new StudioError('the file is larger than 64 MiB', 'cut out the part that is to be seen');
  }
  const headers = {'Content-Type': 'application/octet-stream'};
  const path = `/api/sounds?name=${encodeURIComponent(name.slice(0, 100))}`;
  return (await ask(path, {method: 'POST', headers, body: file})).json() as Promise<Session>;
}

/** The sound as it was heard, a WAV file. */
export async function sound(id: string): Promise<ArrayBuffer> {
  return (await ask(`/api/sessions/${id}/sound.wav`)).arrayBuffer();
}

export async function session(id: string): Promise<Session> {
  return (await ask(`/api/sessions/${encodeURIComponent(id)}`)).json() as Promise<Session>;
}

export async function sendMesh(id: string, file: Blob, name: string, kind: string): Promise<OwnMesh> {
  if (file.size > 32 << 20) throw new StudioError('the mesh is larger than 32 MiB', 'simplify it: a few thousand triangles are enough');
  const headers = {'Content-Type': 'application/octet-stream'};
  const path = `/api/sessions/${id}/mesh?kind=${kind}&name=${encodeURIComponent(name.slice(0, 100))}`;
  return (await ask(path, {method: 'POST', headers, body: file})).json() as Promise<OwnMesh>;
}

/** Makes the session's own object of its mesh. */
export async function makeObject(id: string, request: Record<string, unknown>): Promise<void> {
  await ask(`/api/sessions/${id}/object`, json(request));
}

const meshFile = (id: string, file: string): Promise<Response> => ask(`/api/sessions/${id}/mesh/${file}`);

export async function meshText(id: string, file: 'mesh.obj' | 'mesh.mtl'): Promise<string> {
  return (await meshFile(id, file)).text();
}

/** The mesh as it was sent. */
export async function sentMesh(id: string): Promise<Uint8Array<ArrayBuffer>> {
  return new Uint8Array(await (await meshFile(id, 'upload')).arrayBuffer());
}

export async function saveState(id: string, state: unknown): Promise<void> {
  await ask(`/api/sessions/${id}/state`, {...json(state), method: 'PUT'});
}

export async function readLabels(text: string): Promise<{marks: {start: number; end: number}[]; terminal: boolean}> {
  const headers = {'Content-Type': 'application/octet-stream'};
  const response = await ask('/api/labels', {method: 'POST', headers, body: text});
  return response.json() as Promise<{marks: {start: number; end: number}[]; terminal: boolean}>;
}

export async function motion(id: string, plan: number, take: number): Promise<Motion> {
  return (await ask(takeFile(id, plan, take, 'motion.json'))).json() as Promise<Motion>;
}

/** The same as GLB. */
export async function animation(id: string, plan: number, take: number): Promise<ArrayBuffer> {
  return (await ask(takeFile(id, plan, take, 'motion.glb'))).arrayBuffer();
}

export type Tell = (event: string, data: Record<string, unknown>) => void;

/** Parts of an event stream, in whatever pieces they come. */
export class EventParser {
  private text = '';
  constructor(private readonly tell: Tell) {}

  add(piece: string): void {
    this.text += piece;
    for (let end = this.text.indexOf('\n\n'); end >= 0; end = this.text.indexOf('\n\n')) {
      const event = this.text.slice(0, end);
      this.text = this.text.slice(end + 2);
      const name = /^event: (.*)$/m.exec(event)?.[1];
      const data = /^data: (.*)$/m.exec(event)?.[1];
      if (name && data) this.tell(name, JSON.parse(data) as Record<string, unknown>);
    }
  }
}

/** Runs a job to its end; it is cancelled when `signal` says so or the page goes. */
async function follow(path: string, body: unknown, tell: Tell, signal: AbortSignal): Promise<Record<string, unknown>> {
  const response = await ask(path, {...json(body), signal});
  let end: Record<string, unknown> | null = null;
  let failed = false;
  const parser = new EventParser((event, data) => {
    failed = event === 'failed';
    if (event === 'done' || event === 'failed') end = data;
    else tell(event, data);
  });
  const reader = response.body!.pipeThrough(new TextDecoderStream()).getReader();
  for (let part = await reader.read(); !part.done; part = await reader.read()) parser.add(part.value);
  if (end === null) throw new StudioError('the studio went away', 'is ifa studio still running?');
  const data = end as Record<string, unknown>;
  if (failed) throw new StudioError(String(data['message']), String(data['remedy'] ?? ''));
  return data;
}

export async function plan(id: string, request: PlanRequest, tell: Tell, signal: AbortSignal): Promise<PlanResult> {
  return (await follow(`/api/sessions/${id}/plans`, request, tell, signal)) as unknown as PlanResult;
}

export async function film(id: string, planNumber: number, take: number, final: boolean, tell: Tell,
                           signal: AbortSignal): Promise<void> {
  await follow(takeFile(id, planNumber, take, 'film'), {final, overlay: true}, tell, signal);
}

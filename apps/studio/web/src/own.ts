// SPDX-License-Identifier: Apache-2.0
// An object of one's own: what a mesh is like, what it weighs, and what is wrong with it, in words. Pure.

/** Lengths in the file's own unit. */
export interface MeshReport {
  triangles: number;
  vertices: number;
  openEdges: number;
  inconsistentEdges: number;
  degenerateTriangles: number;
  area: number;
  volume: number;
  extent: [number, number, number];
  solid: boolean;
}

export interface OwnMesh {
  name: string;
  kind: string;
  report: MeshReport;
}

/** Its name where a plan asks for it. */
export const kOwnObject = 'own-object';

export const kMeshKinds = ['obj', 'stl', 'ply', 'off', 'glb'];

/** How a mesh file's name ends; null for other files. */
export function meshKindOf(name: string): string | null {
  return kMeshKinds.find((kind) => name.toLowerCase().endsWith(`.${kind}`)) ?? null;
}

export type Unit = 'mm' | 'cm' | 'm' | 'in';
export const kUnits: Record<Unit, {name: string; metres: number}> = {
  mm: {name: 'millimetres', metres: 0.001}, cm: {name: 'centimetres', metres: 0.01},
  m: {name: 'metres', metres: 1}, in: {name: 'inches', metres: 0.0254},
};

/** kg/m³; how much of its speed a blow leaves, and how much it grips. Those of the library's objects of that material. */
export interface Material {
  name: string;
  density: number;
  restitution: number;
  friction: number;
}
export const kMaterials: Record<string, Material> = {
  plastic: {name: 'plastic', density: 1050, restitution: 0.55, friction: 0.4},
  acrylic: {name: 'acrylic, resin', density: 1190, restitution: 0.75, friction: 0.35},
  wood: {name: 'wood', density: 700, restitution: 0.5, friction: 0.4},
  cork: {name: 'cork', density: 200, restitution: 0.55, friction: 0.5},
  paper: {name: 'paper, cardboard', density: 700, restitution: 0.2, friction: 0.4},
  rubber: {name: 'vinyl, eraser', density: 1300, restitution: 0.34, friction: 0.5},
  glass: {name: 'glass', density: 2500, restitution: 0.7, friction: 0.2},
  ceramic: {name: 'china, stoneware', density: 2350, restitution: 0.5, friction: 0.35},
  stone: {name: 'stone', density: 2600, restitution: 0.55, friction: 0.5},
  aluminium: {name: 'aluminium', density: 2700, restitution: 0.5, friction: 0.3},
  steel: {name: 'steel', density: 7850, restitution: 0.6, friction: 0.35},
  brass: {name: 'brass, bronze', density: 8500, restitution: 0.5, friction: 0.25},
};

/** What a person said of the mesh. */
export interface OwnObject {
  name: string;
  units: Unit;
  material: string;
  shell: boolean;
  /** Of a shell, mm. */
  wall: number;
  /** g; null: as the material has it. */
  mass: number | null;
  /** A drawing of it, as a data URL; empty where nothing draws. */
  picture: string;
}

/** That in which the object has a size that one throws. */
export function guessUnits(kind: string, extent: readonly number[]): Unit {
  if (kind === 'glb') return 'm'; // glTF says so
  const size = Math.max(...extent);
  const fits = (unit: Unit): boolean => size * kUnits[unit].metres >= 0.008 && size * kUnits[unit].metres <= 0.6;
  return (['mm', 'm', 'cm', 'in'] as const).find(fits) ?? 'mm';
}

export function firstGuess({name, kind, report}: OwnMesh): OwnObject {
  return {name: name.replace(/\.[^.]*$/, '') || 'Own object', units: guessUnits(kind, report.extent), material: 'plastic',
          shell: !report.solid, wall: 1, mass: null, picture: ''};
}

/** g, of what it is made of and how. */
export function massOf(report: MeshReport, own: OwnObject): number {
  const scale = kUnits[own.units].metres;
  const volume = own.shell ? report.area * scale ** 2 * (own.wall / 1000) : report.volume * scale ** 3;
  return own.mass ?? 1000 * volume * kMaterials[own.material]!.density;
}

export const roundTo3 = (value: number): string => String(Number(value.toPrecision(3)));

export function sizeText(report: MeshReport, units: Unit): string {
  return `${report.extent.map((side) => roundTo3(1000 * side * kUnits[units].metres)).join(' × ')} mm`;
}

const count = (n: number, what: string): string => `${n.toLocaleString('en')} ${what}${n === 1 ? '' : 's'}`;

/** What should be known of the mesh itself. */
function flaws(report: MeshReport): string[] {
  const texts: string[] = [];
  const shell = 'So it can fall as a hollow thing with a thin wall, but not as a solid one';
  if (report.openEdges > 0) {
    texts.push(`It has holes: at ${count(report.openEdges, 'edge')} the surface ends. ${shell}, until they are closed in a modeller.`);
  }
  if (report.inconsistentEdges > 0) {
    texts.push(`At ${count(report.inconsistentEdges, 'edge')} its inside and outside are swapped from one triangle to the next. ` +
      `${shell}, until the normals are recalculated in a modeller.`);
  }
  if (!report.solid && texts.length === 0) texts.push(`It encloses no space. ${shell}.`);
  if (report.degenerateTriangles > 0) texts.push(`${count(report.degenerateTriangles, 'triangle')} without area; they do no harm.`);
  if (report.triangles > 200000) texts.push(`${count(report.triangles, 'triangle')}: a few thousand are enough, and faster.`);
  return texts;
}

/** @returns all that a person should know, and whether the object can be used like that */
export function explainMesh(report: MeshReport, own: OwnObject): {good: boolean; texts: string[]} {
  const texts = flaws(report);
  const scale = kUnits[own.units].metres;
  const size = Math.max(...report.extent) * scale;
  const mass = massOf(report, own);
  const sized = size >= 2e-4 && size <= 5;
  if (!sized) texts.unshift(`Nothing of ${size > 1 ? `${roundTo3(size)} m` : `${roundTo3(1000 * size)} mm`} can be thrown here: is the file in other units?`);
  else if (size > 2) texts.unshift(`It is ${roundTo3(size)} m long: is the file in other units?`);
  else if (size < 0.001) texts.unshift(`It is only ${roundTo3(1000 * size)} mm long: is the file in other units?`);
  const weighed = mass >= 1e-3 && mass <= 1e6;
  if (!weighed) texts.unshift('The mass must be between a milligram and a tonne.');
  const density = mass / 1000 / (report.volume * scale ** 3);
  if (sized && weighed && !own.shell && own.mass !== null && (density > 23000 || density < 10)) {
    texts.push(density > 23000 ? 'That is heavier than gold of this size.' : 'That is lighter than foam of this size.');
  }
  return {good: sized && weighed && (own.shell || report.solid) && own.wall > 0, texts};
}

/** As it is sent. */
export function objectRequest(report: MeshReport, own: OwnObject): Record<string, unknown> {
  const {restitution, friction} = kMaterials[own.material]!;
  return {units: own.units, shell: own.shell, mass: massOf(report, own) / 1000, restitution, friction};
}

/** Whether it is one, in every field. */
export function isOwnObject(value: unknown): value is OwnObject {
  if (typeof value !== 'object' || value === null) return false;
  const {name, units, material, shell, wall, mass, picture} = value as Record<string, unknown>;
  const number = (one: unknown): boolean => typeof one === 'number' && one > 0 && Number.isFinite(one);
  return typeof name === 'string' && typeof units === 'string' && Object.hasOwn(kUnits, units) &&
    typeof material === 'string' && Object.hasOwn(kMaterials, material) && typeof shell === 'boolean' && number(wall) &&
    (mass === null || number(mass)) && typeof picture === 'string' && /^(data:image\/png;base64,[\w+/=]*)?$/.test(picture);
}

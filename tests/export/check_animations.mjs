// SPDX-License-Identifier: Apache-2.0
// Plays motion.glb and motion.usda in three.js, reads motion.usda with TinyUSDZ, and compares what
// they show with motion.json: node check_animations.mjs FOLDER... One row per reader, lengths in mm;
// fails when one is over its limit, and what is wrong comes last.
import { readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { AnimationMixer, LoopOnce, Matrix4, Quaternion, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { USDLoader } from 'three/addons/loaders/USDLoader.js';
import { readStage } from './read_tinyusdz.mjs';

const LIMIT = 0.2e-3; // m
const TURN_LIMIT = 0.01; // degrees, at contacts
const WIDTHS = [22, 16, 9, 9, 12, 12, 12, 14];
const HEADINGS = ['folder', 'reader', 'contacts', 'instants', 'at contacts', 'below floor',
  'off motion', 'turned, deg'];
const Y_UP_FROM_Z_UP = new Matrix4().makeRotationX(-Math.PI / 2);
const Z_UP_FROM_Y_UP = Y_UP_FROM_Z_UP.clone().invert();

const problems = [];

/** Both quaternions' signs mean the same turn. Radians. */
function angleBetween(a, b) {
  const p = a.clone().normalize();
  const q = b.clone().normalize();
  const chord = (sign) => Math.hypot(p.x - sign * q.x, p.y - sign * q.y, p.z - sign * q.z,
    p.w - sign * q.w);
  return 4 * Math.asin(Math.min(chord(1), chord(-1)) / 2);
}

class Motion {
  constructor(folder) {
    const json = JSON.parse(readFileSync(join(folder, 'motion.json'), 'utf8'));
    const origin = json.sound.first_contact;
    const { time, position, orientation } = json.trajectory;
    this.sound = json.sound.file;
    this.contacts = json.contacts.map((contact) => contact.time + origin);
    this.samples = time.map((t, i) => {
      const [w, x, y, z] = orientation[i];
      return { time: t + origin, place: new Vector3(...position[i]),
        turn: new Quaternion(x, y, z, w) };
    }).filter((sample) => sample.time >= 0);
  }

  /** The sample at a contact: there is one exactly at each. */
  at(time) {
    const found = this.samples.find((sample) => Math.abs(sample.time - time) < 1e-9);
    if (!found) throw new Error(`motion.json has no sample at the contact at ${time} s`);
    return found;
  }
}

/** An animation in three.js, seen with z up as the motion is. */
class Player {
  constructor(root, clip, bodyFromMesh) {
    this.root = root;
    this.bodyFromMesh = bodyFromMesh;
    this.meshFromBody = bodyFromMesh.clone().invert();
    this.body = root.getObjectByName(clip.tracks[0].name.split('.')[0]);
    this.mixer = new AnimationMixer(root);
    const action = this.mixer.clipAction(clip).setLoop(LoopOnce);
    action.clampWhenFinished = true;
    action.play();
    this.points = this.allPoints();
    this.radius = Math.sqrt(Math.max(...this.points.map((point) => point.lengthSq())));
  }

  /** The vertices in the body's axes, each once. */
  allPoints() {
    const points = new Map();
    this.body.traverse((mesh) => {
      const { position, normal } = mesh.geometry?.attributes ?? {};
      for (let i = 0; i < (position?.count ?? 0); i += 1) {
        const point = new Vector3().fromBufferAttribute(position, i).applyMatrix4(this.bodyFromMesh);
        points.set(`${point.x} ${point.y} ${point.z}`, point);
        const length = new Vector3().fromBufferAttribute(normal, i).length();
        if (!(Math.abs(length - 1) < 1e-3)) throw new Error(`a normal has the length ${length}`);
      }
    });
    return [...points.values()];
  }

  at(time) {
    this.mixer.setTime(time);
    this.root.updateMatrixWorld(true);
    const matrix = Z_UP_FROM_Y_UP.clone().multiply(this.body.matrixWorld).multiply(this.meshFromBody);
    const place = new Vector3();
    const turn = new Quaternion();
    matrix.decompose(place, turn, new Vector3());
    return { place, turn, matrix };
  }

  lowest({ matrix: { elements: m } }) {
    let low = Infinity;
    for (const { x, y, z } of this.points) low = Math.min(low, m[2] * x + m[6] * y + m[10] * z);
    return low + m[14];
  }
}

function row(cells) {
  console.log(cells.map((cell, i) => (i < 2 ? String(cell).padEnd(WIDTHS[i])
    : String(cell).padStart(WIDTHS[i]))).join(''));
}

const mm = (length) => (1000 * length).toFixed(4);

function report(folder, reader, counts, { touching, sunk, off, turned }) {
  row([basename(folder), reader, ...counts, touching === undefined ? '' : mm(touching),
    sunk === undefined ? '' : mm(sunk), mm(off), turned.toFixed(5)]);
  const limit = (value, most, text) => {
    if (!(value <= most)) problems.push(`${folder}: ${reader}: ${text}`);
  };
  limit(touching ?? 0, LIMIT, `the lowest point is ${mm(touching)} mm from the floor at a contact`);
  limit(sunk ?? 0, LIMIT, `the body sinks ${mm(sunk)} mm into the floor`);
  limit(off, LIMIT, `a point is ${mm(off)} mm off motion.json`);
  limit(turned, TURN_LIMIT, `turned by ${turned} degrees at a contact`);
}

function checkPlayer(folder, reader, motion, player) {
  const worst = { touching: 0, sunk: -Infinity, off: 0, turned: 0 };
  const contacts = new Set(motion.contacts.map((time) => motion.at(time)));
  for (const sample of motion.samples) {
    const pose = player.at(sample.time);
    const turned = angleBetween(pose.turn, sample.turn);
    const low = player.lowest(pose);
    const off = pose.place.distanceTo(sample.place) + player.radius * turned;
    worst.off = Math.max(worst.off, off);
    worst.sunk = Math.max(worst.sunk, -low);
    if (contacts.has(sample)) {
      worst.touching = Math.max(worst.touching, Math.abs(low));
      worst.turned = Math.max(worst.turned, turned * 180 / Math.PI);
    }
  }
  report(folder, reader, [motion.contacts.length, motion.samples.length], worst);
}

function expectEqual(folder, what, found, wanted) {
  if (found !== wanted) problems.push(`${folder}: TinyUSDZ: ${what} is ${found} instead of ${wanted}`);
}

/** The samples themselves at the contacts: TinyUSDZ gives times with six digits. */
function checkStage(folder, motion, meshes) {
  const stage = readStage(join(folder, 'motion.usda'));
  const wanted = { root: 'motion', metersPerUnit: 1, upAxis: '"Z"', codesPerSecond: 24,
    defaultPrim: '"motion"', meshes };
  for (const [what, value] of Object.entries(wanted)) expectEqual(folder, what, stage[what], value);
  if (motion.sound !== '') {
    expectEqual(folder, 'sound', stage.sound, `./${motion.sound}`);
    expectEqual(folder, 'auralMode', stage.auralMode, '"nonSpatial"');
  }
  expectEqual(folder, 'the number of turns', stage.turns.length, stage.places.length);
  const worst = { off: 0, turned: 0 };
  for (const time of motion.contacts) {
    const truth = motion.at(time);
    const codes = stage.places.map(([code]) => Math.abs(code / stage.codesPerSecond - time));
    const nearest = codes.indexOf(Math.min(...codes));
    if (!(codes[nearest] < 3e-5)) {
      problems.push(`${folder}: TinyUSDZ: no sample at the contact at ${time} s`);
      continue;
    }
    const [w, x, y, z] = stage.turns[nearest][1];
    worst.off = Math.max(worst.off, truth.place.distanceTo(new Vector3(...stage.places[nearest][1])));
    worst.turned = Math.max(worst.turned,
      angleBetween(new Quaternion(x, y, z, w), truth.turn) * 180 / Math.PI);
  }
  report(folder, 'TinyUSDZ usda', [motion.contacts.length, stage.places.length], worst);
}

/** What no player shows: signs of quaternions that flip, which some importers stumble over, and the
 * contacts in the extras. */
function checkGlb(folder, motion, player, clip) {
  const { times, values } = clip.tracks.find((track) => track.name.endsWith('.quaternion'));
  for (let i = 1; i < times.length; i += 1) {
    let dot = 0;
    for (let k = 0; k < 4; k += 1) dot += values[4 * i + k] * values[4 * i + k - 4];
    if (dot < 0) problems.push(`${folder}: motion.glb: the quaternion flips at ${times[i]} s`);
  }
  const starts = player.body.userData.contact_starts ?? [];
  if (starts.length !== motion.contacts.length
    || starts.some((start, i) => Math.abs(start - motion.contacts[i]) > 1e-9)) {
    problems.push(`${folder}: motion.glb: contact_starts are not those of motion.json`);
  }
}

async function check(folder) {
  const motion = new Motion(folder);
  const glb = readFileSync(join(folder, 'motion.glb'));
  const model = await new GLTFLoader().parseAsync(
    glb.buffer.slice(glb.byteOffset, glb.byteOffset + glb.byteLength), '');
  const player = new Player(model.scene, model.animations[0], Z_UP_FROM_Y_UP);
  checkPlayer(folder, 'three.js glb', motion, player);
  checkGlb(folder, motion, player, model.animations[0]);
  const stage = new USDLoader().parse(readFileSync(join(folder, 'motion.usda'), 'utf8'));
  checkPlayer(folder, 'three.js usda', motion,
    new Player(stage, stage.animations[0], new Matrix4()));
  let meshes = 0;
  stage.traverse((object) => { meshes += object.isMesh ? 1 : 0; });
  checkStage(folder, motion, meshes);
}

row(HEADINGS);
const folders = process.argv.slice(2);
for (const folder of folders) {
  try {
    await check(folder);
  } catch (error) {
    problems.push(`${folder}: ${error.message}`);
  }
}
for (const problem of problems) console.error(problem);
process.exit(problems.length > 0 || folders.length === 0 ? 1 : 0);

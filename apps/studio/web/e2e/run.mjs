// SPDX-License-Identifier: Apache-2.0
// run.mjs IFA SOUND [--plays N] [PICTURES]: the studio from end to end in a browser, as a person uses
// it. Prints what it measured; ends with an error at the first thing that is not as it should be.
// PICTURES: a folder for screenshots. N: playbacks over which the synchrony is measured.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {basename, join} from 'node:path';
import {parseArgs} from 'node:util';
import {animate, chooseObject, openSound, withStudio} from './studio.mjs';
import {tablet} from './tablet.mjs';

const {values: {plays}, positionals: [program, sound, pictures]} = parseArgs({
  allowPositionals: true, options: {plays: {type: 'string', default: '2'}},
});
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

const report = (what, value) => console.log(`${what}: ${value}`);
const picture = (page, name) => pictures && page.screenshot({path: join(pictures, name)});
const startOf = (page, n) => page.locator('.mark').nth(n).getAttribute('aria-valuenow').then(Number);
const marks = (page) => page.locator('.mark').count();

/** No violation of the accessibility rules that is serious. */
async function checkAccess(page, where) {
  // Colours on their way from one to the other are neither.
  await page.evaluate(async () => {
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    const fading = document.getAnimations().filter((one) => one instanceof CSSTransition);
    await Promise.allSettled(fading.map((one) => one.finished));
  });
  const found = await page.evaluate(`${axe}; axe.run(document, {resultTypes: ['violations']})`);
  const bad = found.violations.filter(({impact}) => impact === 'serious' || impact === 'critical');
  const told = bad.map(({id, nodes}) => `${id}: ${nodes.map((node) => node.target).join(' ')}`);
  assert.deepEqual(told, [], `accessibility, ${where}`);
}

async function download(page, act) {
  const [file] = await Promise.all([page.waitForEvent('download', {timeout: 60000}), act()]);
  return {name: file.suggestedFilename(), path: await file.path()};
}

async function welcome(page, studio) {
  const start = Date.now();
  await page.goto(studio.address);
  await page.waitForSelector('#drop h2');
  report('first useful picture, ms', Date.now() - start);
  await checkAccess(page, 'first page');
  await page.waitForTimeout(pictures ? 2500 : 0);
  await picture(page, 'studio-open.png');
}

async function edit(page) {
  const before = await marks(page);
  assert.ok(before >= 3, `${before} contacts`);
  await page.locator('.mark').nth(1).focus();
  const start = await startOf(page, 1);
  await page.keyboard.press('ArrowRight');
  assert.ok(Math.abs((await startOf(page, 1)) - start - 0.001) < 2e-4, 'an arrow is a millisecond');
  await page.keyboard.press('Control+z');
  assert.equal(await startOf(page, 1), start);
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('o');
  assert.ok(Math.abs((await startOf(page, 1)) - start) < 0.003, 'snaps back to the attack');
  await page.keyboard.press('Delete');
  assert.equal(await marks(page), before - 1);
  await page.keyboard.press('Control+z');
  assert.equal(await marks(page), before);
  await drag(page);
  const labels = await download(page, () => page.click('#labels-out'));
  const lines = readFileSync(labels.path, 'utf8').trim().split('\n');
  assert.equal(lines.length, before);
  assert.match(lines.at(-1), /terminal$/);
  await page.setInputFiles('#labels-file', {name: 'x.txt', mimeType: 'text/plain', buffer: Buffer.from('0,2\t0,2\ta\n0.4\t0.5\tnon-terminal')});
  await page.waitForFunction(() => document.querySelectorAll('.mark').length === 2);
  assert.equal(await page.isChecked('#terminal'), false);
  await page.keyboard.press('Control+z');
  assert.equal(await marks(page), before);
}

async function drag(page) {
  const start = await startOf(page, 1);
  const box = await page.locator('.mark').nth(1).boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + 60);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 40, box.y + 60, {steps: 4});
  await page.mouse.up();
  assert.ok((await startOf(page, 1)) > start, 'a drag moves it');
  await page.keyboard.press('Control+z');
  assert.equal(await startOf(page, 1), start);
}

/**
 * While it plays: each contact has a frame that shows it, drawn within one frame of when it is heard,
 * in which the body touches the floor.
 */
async function checkSync(page, times) {
  const result = await page.evaluate(async (count) => {
    const {studio} = window;
    const {contacts} = studio;
    const worst = {clock: 0, floor: 0, frames: 0, seconds: 0, missed: 0};
    const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
    const playing = () => document.getElementById('play').classList.contains('on');
    if (!playing()) document.getElementById('play').click();
    while (studio.heard > 0.1) await frame(); // until it begins anew
    const started = performance.now();
    for (let play = 0; play < count; ++play) {
      const frames = [];
      for (let before = -1; ; before = studio.heard) {
        await frame(); // the page's own was before this
        const {heard, shown} = studio;
        if (heard < before) break;
        frames.push({heard, shown, lasted: heard - before});
      }
      worst.frames += frames.length;
      contacts.forEach((contact, i) => {
        const off = ({heard, shown}) => Math.abs(heard - contact) + (shown === contact ? 0 : 9);
        const best = frames.reduce((a, b) => (off(b) < off(a) ? b : a));
        worst.clock = Math.max(worst.clock, Math.abs(best.heard - contact));
        // Of contacts closer than two frames not all can be shown.
        const alone = Math.min((contacts[i + 1] ?? 9) - contact, contact - (contacts[i - 1] ?? -9));
        const slow = frames.some(({heard, lasted}) => lasted > Math.min(0.1, alone / 2) && heard >= contact && heard - lasted <= contact);
        if (!slow && (best.shown !== contact || Math.abs(best.heard - contact) > best.lasted)) ++worst.missed;
      });
    }
    worst.seconds = (performance.now() - started) / 1000;
    if (playing()) document.getElementById('play').click();
    for (const time of contacts) worst.floor = Math.max(worst.floor, Math.abs(studio.lowestAt(time)));
    return worst;
  }, times);
  report('playbacks', times);
  report('frames a second, software rendering', (result.frames / result.seconds).toFixed(1));
  report('body from the floor in frames that show a contact, mm at most', (1e3 * result.floor).toFixed(3));
  report('audio clock from the contact then, ms at most', (1e3 * result.clock).toFixed(1));
  assert.equal(result.missed, 0, 'every contact has its frame');
  assert.ok(result.floor < 1e-3, 'touches at every contact');
}

const pause = (page) => page.evaluate(() => {
  const play = document.getElementById('play');
  if (play.classList.contains('on')) play.click();
});

/** Where the body shows a face that has a name, px: looked for on a grid. */
async function faceOnScreen(page) {
  await page.keyboard.press('Escape');
  const box = await page.locator('#large').boundingBox();
  for (let y = 0.3; y < 0.75; y += 0.04) {
    for (let x = 0.35; x < 0.65; x += 0.02) {
      await page.mouse.move(box.x + x * box.width, box.y + y * box.height);
      const tip = await page.textContent('#tip');
      if (await page.isVisible('#tip') && tip.startsWith('Click')) return tip.match(/with (\S+) up/)[1];
    }
  }
  throw new Error('no face is seen');
}

async function wishes(page) {
  const seen = await faceOnScreen(page);
  await animate(page, async () => (await page.mouse.down(), await page.mouse.up()));
  assert.equal(await page.getAttribute(`#faces button:has-text("${seen}")`, 'aria-checked'), 'true');
  await page.click('#play');
  const ms = await animate(page, () => page.click(`#faces button:has-text("${seen === '6' ? 5 : 6}")`));
  report('face demanded to takes, ms', Math.round(ms));
  await page.locator('.mark').nth(1).focus();
  await page.keyboard.press('ArrowRight');
  assert.equal(await page.textContent('#plan'), 'Animate again');
  report('mark moved to takes, ms', Math.round(await animate(page, () => page.keyboard.press('Control+Enter'))));
}

const motionOf = (page) => page.evaluate(async () => (await fetch(document.querySelector('a[data-file="motion.json"]').href)).json());

/** From the first contact to the last, cm, as the chosen take has it. */
async function landed(page) {
  const {contacts} = await motionOf(page);
  const [a, b] = [contacts[0].position, contacts.at(-1).position];
  return 100 * Math.hypot(b[0] - a[0], b[1] - a[1]);
}

/** The landing place is dragged, moved by keys, and given up. */
async function landing(page) {
  const text = () => page.textContent('#landing-text');
  const asked = async () => parseFloat((await text()).replace(' mm', 'e-1'));
  assert.equal(await text(), 'anywhere');
  const free = await landed(page);
  await pause(page);
  await page.evaluate(() => window.studio.seek(1e9)); // so that it lies in sight
  await page.waitForFunction(() => !document.getElementById('landing').classList.contains('far'));
  const grip = async () => {
    const box = await page.locator('#landing').boundingBox();
    return [box.x + box.width / 2, box.y + box.height / 2];
  };
  const [x, y] = await grip();
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 90, y + 20, {steps: 5});
  assert.notEqual(await text(), 'anywhere');
  await page.waitForTimeout(pictures ? 600 : 0);
  await picture(page, 'studio-landing.png');
  report('landing dragged to takes, ms', Math.round(await animate(page, () => page.mouse.up())));
  const wish = await asked();
  assert.ok(Math.abs(wish - free) > 0.5, `${wish} cm asked for, ${free} cm before`);
  const there = await landed(page);
  report('landing, cm', `${free.toFixed(1)} before, ${wish} asked for, ${there.toFixed(1)} then`);
  assert.ok(Math.abs(there - wish) < 0.25 * wish, `lands ${there} cm from its start`);
  await page.focus('#landing');
  await animate(page, async () => {
    for (let i = 0; i < 4; ++i) await page.keyboard.press('ArrowRight');
  });
  assert.notEqual(await asked(), wish);
  assert.match(await page.getAttribute('#landing', 'aria-label'), /from where it first touches, asked for$/);
  await page.waitForFunction(() => document.activeElement.id === 'landing');
  await reloaded(page);
  assert.notEqual(await text(), 'anywhere');
  await animate(page, () => page.click('#landing-clear'));
  assert.equal(await text(), 'anywhere');
  assert.equal((await motionOf(page)).positions, undefined);
}

async function reloaded(page) {
  await page.waitForTimeout(500); // what was changed last is saved a moment later
  await page.reload();
  await page.waitForSelector('.take');
}

async function exports(page, folder) {
  const glb = await download(page, () => page.click('a[data-file="motion.glb"]'));
  assert.equal(readFileSync(glb.path).subarray(0, 4).toString(), 'glTF');
  assert.equal(glb.name, `${basename(sound).replace(/\.[^.]*$/, '')}-take-1.glb`);
  for (const [file, begins] of [['motion.usda', '#usda'], ['motion.csv', 'time'], ['sound.wav', 'RIFF']]) {
    const got = await download(page, () => page.click(`a[data-file="${file}"]`));
    assert.ok(readFileSync(got.path).toString('latin1').startsWith(begins), file);
  }
  const film = await download(page, () => page.click('#export-film'));
  assert.equal(readFileSync(film.path).subarray(4, 8).toString(), 'ftyp');
  // The motion that was shown, judged where it lies: beside its object.
  const url = await page.getAttribute('a[data-file="motion.json"]', 'href');
  const [, session, plan, take] = /sessions\/(\w+)\/plans\/(\d+)\/takes\/(\d+)/.exec(url);
  const where = join(folder, 'sessions', session, `plan-${plan}`, 'out', `take-${take}`, 'motion.json');
  const verdict = spawnSync(program, ['verify', where], {encoding: 'utf8'});
  assert.equal(verdict.status, 0, verdict.stdout + verdict.stderr);
}

/** A project opened in another session is what it was, takes included. */
async function project(page, count) {
  const motion = () => page.evaluate(async () => (await fetch(document.querySelector('a[data-file="motion.glb"]').href)).text());
  const before = await motion();
  const file = await download(page, () => page.click('#save-project'));
  await page.click('#new-sound');
  await animate(page, () => page.setInputFiles('#sound-file', {name: file.name, mimeType: '', buffer: readFileSync(file.path)}));
  assert.equal(await marks(page), count);
  assert.ok((await motion()) === before, 'the same motion');
}

/** A box of 30 x 20 x 10 as text STL: solid, then without its last two triangles. */
function boxAsStl(triangles) {
  const corner = (i) => [30 * (i & 1), 20 * ((i >> 1) & 1), 10 * (i >> 2)];
  const sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
  const facets = sides.flatMap(([a, b, c, d]) => [[a, b, c], [a, c, d]]).slice(0, triangles)
    .map((facet) => `facet normal 0 0 0\nouter loop\n${facet.map((i) => `vertex ${corner(i).join(' ')}\n`).join('')}endloop\nendfacet\n`);
  return Buffer.from(`solid box\n${facets.join('')}endsolid box\n`);
}

/** A mesh of one's own: explained, given a size and a material, animated, and there after a reload. */
async function ownMesh(page) {
  const drawn = () => page.waitForFunction(() => performance.getEntriesByName('mesh drawn').length > 0);
  await page.setInputFiles('#mesh-file', {name: 'open.stl', mimeType: '', buffer: boxAsStl(10)});
  await page.waitForSelector('#mesh[open]');
  assert.match(await page.textContent('#mesh-problems'), /It has holes: at 4 edges/);
  assert.ok(await page.isDisabled('#mesh-solid'));
  await page.evaluate(() => performance.clearMarks('mesh drawn'));
  await page.setInputFiles('#mesh-file', {name: 'box.stl', mimeType: '', buffer: boxAsStl(12)});
  await page.waitForFunction(() => document.getElementById('mesh-title').textContent === 'box.stl');
  assert.equal(await page.textContent('#mesh-size'), '30 × 20 × 10 mm');
  await page.selectOption('#mesh-units', 'm');
  assert.ok(await page.isDisabled('#mesh-use'));
  await page.selectOption('#mesh-units', 'mm');
  await page.selectOption('#mesh-material', 'wood');
  assert.equal(await page.inputValue('#mesh-mass'), '4.2');
  await drawn();
  await page.waitForTimeout(pictures ? 500 : 0);
  await checkAccess(page, 'own mesh');
  await picture(page, 'studio-mesh.png');
  await page.click('#mesh-use');
  await page.waitForSelector('#mesh:not([open])', {state: 'attached'});
  await animate(page);
  assert.ok(Math.abs((await motionOf(page)).object.mass - 0.0042) < 1e-6);
  await reloaded(page);
  assert.equal(await page.textContent('#object-title'), 'box');
  assert.match(await page.textContent('#object-note'), /^wood, 4.2 g$/);
}

/** Chromium's own microphone beeps once a second. */
async function record(page) {
  await page.click('#new-sound');
  await page.click('#record');
  await page.waitForFunction(() => parseFloat(document.getElementById('record').textContent.slice(7)) > 1.2);
  await page.click('#record');
  await page.waitForSelector('.mark');
  assert.equal(await page.textContent('#sound-name'), 'recording.wav');
}

async function reload(page, count) {
  await reloaded(page);
  assert.equal(await marks(page), count);
  assert.equal(await page.locator('.take').count(), 3);
  assert.equal(await page.getAttribute('#faces button:has-text("any")', 'aria-checked'), 'false');
}

await withStudio(program, async ({page, context, studio, folder}) => {
  const problems = [];
  context.on('requestfinished', (request) => {
    const url = request.url();
    if (!url.startsWith(studio.address) && !/^(blob|data):/.test(url)) problems.push(`asked elsewhere: ${url}`);
  });
  page.on('pageerror', (error) => problems.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && problems.push(message.text()));
  await welcome(page, studio);
  await openSound(page, sound);
  await edit(page);
  const count = await marks(page);
  await chooseObject(page, 'six-sided');
  report('first takes of an object, ms', Math.round(await animate(page)));
  assert.equal(await page.locator('.take').count(), 3);
  await checkSync(page, Number(plays));
  const box = await page.locator('#track').boundingBox();
  await page.mouse.click(box.x + box.width * 0.43, box.y + 130);
  const duration = Number(await page.locator('.mark').first().getAttribute('aria-valuemax'));
  await page.waitForFunction((time) => Math.abs(parseFloat(document.getElementById('clock').textContent) - time) < 0.01, 0.43 * duration);
  await page.waitForTimeout(pictures ? 700 : 0);
  await picture(page, 'studio-takes.png');
  await checkAccess(page, 'editor');
  await wishes(page);
  await landing(page);
  await exports(page, folder);
  await reload(page, count);
  await page.emulateMedia({colorScheme: 'dark'});
  await page.waitForTimeout(pictures ? 900 : 100);
  await checkAccess(page, 'dark');
  await picture(page, 'studio-dark.png');
  await page.click('#object');
  await page.waitForTimeout(pictures ? 600 : 0);
  await checkAccess(page, 'objects');
  await picture(page, 'studio-objects.png');
  await page.click('#objects [data-close]');
  await page.emulateMedia({colorScheme: 'light'});
  await tablet(page.url(), context.browser(), {picture, checkAccess});
  await ownMesh(page);
  await project(page, count);
  await record(page);
  assert.deepEqual(problems, []);
});
console.log('1 passed, 0 failed');

// SPDX-License-Identifier: Apache-2.0
// The studio under fingers, upright and across.
import assert from 'node:assert/strict';
import {animate} from './studio.mjs';

/** What is touched is this large at least, px. */
const kTarget = 40;

async function finger(page) {
  const session = await page.context().newCDPSession(page);
  const send = (type, points) => session.send('Input.dispatchTouchEvent', {type, touchPoints: points.map(([x, y], id) => ({x, y, id}))});
  /** @param ways for each finger [from, to], each [x, y] */
  return async (...ways) => {
    await send('touchStart', ways.map(([from]) => from));
    for (let step = 1; step <= 5; ++step) {
      await send('touchMove', ways.map(([from, to]) => from.map((value, i) => value + (step / 5) * (to[i] - value))));
    }
    await send('touchEnd', []);
  };
}

/** Nothing goes over the edge, nothing is too small for a finger. */
async function checkLayout(page, where) {
  const found = await page.evaluate((least) => {
    const seen = [...document.querySelectorAll('button, select, a.button, summary, label.check, input')]
      .filter((one) => one.checkVisibility() && !one.closest('label.check input') && !one.matches('label.check input'));
    const name = (one) => one.id || one.textContent.trim();
    const boxes = seen.map((one) => [name(one), one.getBoundingClientRect()]);
    return {
      small: boxes.filter(([, box]) => Math.min(box.width, box.height) < least).map(([id, box]) => `${id} ${box.width.toFixed(0)}x${box.height.toFixed(0)}`),
      outside: boxes.filter(([, box]) => box.left < -1 || box.right > innerWidth + 1).map(([id]) => id),
      wide: document.documentElement.scrollWidth - innerWidth,
    };
  }, kTarget);
  assert.deepEqual(found, {small: [], outside: [], wide: 0}, where);
}

/** @param url of a session with takes */
export async function tablet(url, browser, {picture, checkAccess}) {
  for (const [width, height] of [[768, 1024], [1024, 768]]) {
    const where = `${width}x${height}`;
    const context = await browser.newContext({viewport: {width, height}, hasTouch: true, isMobile: true});
    context.setDefaultTimeout(90000);
    const page = await context.newPage();
    await page.goto(url);
    await page.waitForSelector('.take');
    await page.waitForTimeout(800);
    await checkLayout(page, where);
    await picture(page, `studio-tablet-${where}.png`);
    if (width < height) await touch(page);
    else await checkAccess(page, where);
    await page.tap('#object');
    await checkLayout(page, `${where}, objects`);
    await picture(page, `studio-tablet-${where}-objects.png`);
    await page.tap('#objects [data-close]');
    await context.close();
  }
}

async function touch(page) {
  const drag = await finger(page);
  const mark = () => page.locator('.mark').nth(1);
  const start = async () => Number(await mark().getAttribute('aria-valuenow'));
  const middle = async (locator) => {
    const box = await locator.boundingBox();
    return [box.x + box.width / 2, box.y + box.height / 2];
  };
  const view = () => page.evaluate(() => document.querySelectorAll('.mark:not([hidden])').length);

  // A number is dragged by a finger that is beside it.
  const before = await start();
  const [x] = await middle(mark());
  const {y} = await page.locator('#track').boundingBox();
  await drag([[x + 9, y + 30], [x + 39, y + 30]]);
  assert.ok((await start()) > before, 'a finger moves a contact');
  assert.ok(await page.isVisible('#tip'), 'and is told of it');
  await page.tap('#undo');
  assert.equal(await start(), before);

  // Two fingers zoom in.
  const all = await view();
  await drag([[300, y + 120], [100, y + 120]], [[400, y + 120], [700, y + 120]]);
  assert.ok((await view()) < all, 'two fingers zoom');
  await drag([[100, y + 120], [360, y + 120]], [[700, y + 120], [400, y + 120]]);

  await page.evaluate(() => window.studio.seek(1e9));
  await page.waitForFunction(() => !document.getElementById('landing').classList.contains('far'));
  const [gx, gy] = await middle(page.locator('#landing'));
  await animate(page, () => drag([[gx, gy], [gx + 60, gy + 10]]));
  assert.match(await page.textContent('#landing-text'), /from its start/);
  await animate(page, () => page.tap('#landing-clear'));
}

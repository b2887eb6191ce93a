// SPDX-License-Identifier: Apache-2.0
// Starts `ifa studio` and a browser for the end-to-end test and the pictures of the documentation.
import {spawn} from 'node:child_process';
import {existsSync, mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {chromium} from 'playwright-core';

export const browserPath = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);

/** @returns the studio's address, and how to end it */
export async function startStudio(program, folder) {
  const child = spawn(program, ['studio', '--port', '0', '--folder', folder], {stdio: ['ignore', 'pipe', 'inherit']});
  const address = await new Promise((resolve, reject) => {
    let text = '';
    child.stdout.on('data', (piece) => {
      text += piece;
      const found = /http:\/\/\S+/.exec(text);
      if (found) resolve(found[0]);
    });
    child.on('exit', (code) => reject(new Error(`ifa studio ended with ${code}`)));
  });
  return {address, stop: () => new Promise((resolve) => (child.on('exit', resolve), child.kill('SIGINT')))};
}

/** Calls `use` with a page at the studio, a studio and a folder of its own; cleans up whatever happens. */
export async function withStudio(program, use, options = {}) {
  const folder = mkdtempSync(join(tmpdir(), 'ifa-studio-'));
  const studio = await startStudio(program, join(folder, 'sessions'));
  const browser = await chromium.launch({
    executablePath: browserPath,
    args: ['--no-sandbox', '--autoplay-policy=no-user-gesture-required', '--use-fake-device-for-media-stream',
           '--use-fake-ui-for-media-stream'],
  });
  try {
    const context = await browser.newContext({viewport: {width: 1280, height: 720}, acceptDownloads: true, ...options});
    context.setDefaultTimeout(90000); // of machines that do other work too
    await use({page: await context.newPage(), context, studio, folder});
  } finally {
    await browser.close();
    await studio.stop();
    rmSync(folder, {recursive: true, force: true});
  }
}

/** Opens a sound as a person would by the button. */
export async function openSound(page, sound) {
  await page.setInputFiles('#sound-file', sound);
  await page.waitForSelector('.mark', {timeout: 60000});
}

export async function chooseObject(page, words) {
  await page.click('#object');
  await page.fill('#object-search', words);
  await page.press('#object-search', 'Enter');
}

/** Presses Animate, waits for the takes. @returns ms that this took */
export async function animate(page, act = () => page.click('#plan')) {
  const before = await page.evaluate(() => performance.getEntriesByName('edit to takes').length);
  await act();
  await page.waitForFunction((count) => performance.getEntriesByName('edit to takes').length > count, before, {timeout: 90000});
  return page.evaluate(() => performance.getEntriesByName('edit to takes').at(-1).duration);
}

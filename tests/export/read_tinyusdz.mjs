// SPDX-License-Identifier: Apache-2.0
// TinyUSDZ in node: its package is built for browsers and looks at global names to find out where
// it is, so it is shown what a browser has while it starts.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

async function start() {
  const { process } = globalThis;
  globalThis.window = globalThis;
  globalThis.process = undefined;
  try {
    const { default: load } = await import('tinyusdz');
    const wasm = createRequire(import.meta.url).resolve('tinyusdz/tinyusdz.wasm');
    return await load({ wasmBinary: readFileSync(wasm) });
  } finally {
    globalThis.process = process;
    delete globalThis.window;
  }
}

const tinyusdz = await start();

/** `name.timeSamples` in the text of a layer: [[code, [number, ...]], ...]. */
function timeSamples(text, name) {
  const start = text.indexOf(`${name}.timeSamples = {`);
  if (start < 0) return [];
  const block = text.slice(text.indexOf('{', start) + 1, text.indexOf('}', start));
  return block.trim().split('\n').map((line) => {
    const [code, ...values] = line.match(/[-+.\de]+/g).map(Number);
    return [code, values];
  });
}

/** What TinyUSDZ understands of a USDA file, from the text in which it writes the stage again. */
export function readStage(path) {
  const loader = new tinyusdz.TinyUSDZLoaderNative();
  try {
    const bytes = readFileSync(path);
    for (const load of ['loadFromBinary', 'loadAsLayerFromBinary']) {
      if (!loader[load](bytes, 'motion.usda')) throw new Error(`TinyUSDZ: ${loader.error()}`);
    }
    const text = loader.layerToString();
    const field = (name) => text.match(new RegExp(`${name} = (.*)`))?.[1];
    const root = loader.getDefaultRootNode();
    return {
      root: root.primName,
      prims: root.children.map((prim) => prim.primName),
      meshes: loader.numMeshes(),
      metersPerUnit: Number(field('metersPerUnit')),
      upAxis: field('upAxis'),
      codesPerSecond: Number(field('timeCodesPerSecond')),
      defaultPrim: field('defaultPrim'),
      places: timeSamples(text, 'xformOp:translate'),
      turns: timeSamples(text, 'xformOp:orient'),
      sound: text.match(/def SpatialAudio "\w+"\s*\{[^}]*filePath = @([^@]*)@/)?.[1],
      auralMode: field('auralMode'),
    };
  } finally {
    loader.delete();
  }
}

// SPDX-License-Identifier: Apache-2.0
// Khronos glTF validator: node validate_glb.mjs FILE.glb... ; fails on any error or warning.
import { readFileSync } from 'node:fs';
import validator from 'gltf-validator';

let bad = 0;
for (const path of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(path)), { uri: path });
  const { numErrors, numWarnings, messages } = report.issues;
  for (const message of messages) {
    console.log(`${path}: ${message.code} ${message.pointer ?? ''} ${message.message}`);
  }
  if (numErrors + numWarnings > 0) bad += 1;
  console.log(`${path}: ${numErrors} errors, ${numWarnings} warnings`);
}
process.exit(bad > 0 ? 1 : 0);

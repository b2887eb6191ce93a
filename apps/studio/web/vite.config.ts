// SPDX-License-Identifier: Apache-2.0
import {defineConfig} from 'vite';

export default defineConfig({
  base: '/',
  // Pictures of the objects lie with the documentation.
  server: {fs: {allow: ['../../..']}},
  build: {target: 'es2022', assetsInlineLimit: 0, emptyOutDir: true, chunkSizeWarningLimit: 900, modulePreload: {polyfill: false}},
});

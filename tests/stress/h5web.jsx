// SPDX-License-Identifier: GPL-3.0-or-later
// H5Web as its makers describe it: the viewer on the file that the page's address names. Bundled by h5web.sh, used by h5web.py.
import { App } from '@h5web/app';
import { H5WasmBufferProvider } from '@h5web/h5wasm';
import '@h5web/app/styles.css';
import { createRoot } from 'react-dom/client';

const name = new URLSearchParams(location.search).get('file');
const buffer = await (await fetch(name)).arrayBuffer();
createRoot(document.getElementById('root')).render(
  <H5WasmBufferProvider filename={name} buffer={buffer}>
    <App />
  </H5WasmBufferProvider>
);

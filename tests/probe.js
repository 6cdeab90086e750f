/* SPDX-License-Identifier: GPL-3.0-or-later */
// Values of datasets as a reader in JavaScript has them: node probe.js jsfive|h5wasm FILE.h5 DATASET...
// Prints one line each: how many values there are, then some of them. readers.py compares.
"use strict";
const fs = require("fs");

const [library, path, ...datasets] = process.argv.slice(2);

async function open() {
    if (library === "jsfive") {
        const jsfive = require("jsfive");
        const bytes = fs.readFileSync(path);
        return new jsfive.File(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), path);
    }
    // `import` does not look into NODE_PATH.
    const h5wasm = await import(require("url").pathToFileURL(`${process.env.NODE_PATH}/h5wasm/dist/node/hdf5_hl.js`));
    await h5wasm.default.ready;
    return new h5wasm.default.File(path, "r");
}

async function main() {
    const file = await open();
    for (const name of datasets) {
        const values = file.get(name).value;
        const some = [];
        for (let i = 0; i < 1000; i++)
            some.push(String(values[Math.floor((i * (values.length - 1)) / 999)]));
        console.log([values.length, ...some].join(" "));
    }
}

main().catch((error) => {
    console.error(String(error));
    process.exitCode = 1;
});

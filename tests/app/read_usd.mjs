// node read_usd.mjs MODULES FILE: reads USD with tinyusdz and prints {"error": ..., "meshes": [number of points of each]}.
import fs from "fs";
import path from "path";
import url from "url";

const place = path.join(process.argv[2], "tinyusdz");
// The package is made for browsers; it needs nothing of theirs but to be told that it is in one.
globalThis.window = globalThis;
process.type = "renderer";
const { default: start } = await import(url.pathToFileURL(path.join(place, "tinyusdz.js")));
const module = await start({
    instantiateWasm(info, done) {
        WebAssembly.instantiate(fs.readFileSync(path.join(place, "tinyusdz.wasm")), info)
            .then(result => done(result.instance, result.module));
        return {};
    },
});
const usd = new module.TinyUSDZLoaderNative();
const read = usd.loadFromBinary(new Uint8Array(fs.readFileSync(process.argv[3])), "file.usda");
const meshes = [];
for (let i = 0; read && i < usd.numMeshes(); ++i)
    meshes.push(usd.getMesh(i).points.length / 3);
console.log(JSON.stringify({ read, error: usd.error(), meshes }));

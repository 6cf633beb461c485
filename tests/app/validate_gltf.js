// node validate_gltf.js MODULES FILE...: prints the report of Khronos' validator on each file as JSON, one a line.
const fs = require("fs");
const path = require("path");
const validator = require(path.join(process.argv[2], "gltf-validator"));

(async () => {
    for (const file of process.argv.slice(3)) {
        const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { maxIssues: 50 });
        console.log(JSON.stringify({ version: report.validatorVersion, issues: report.issues, info: report.info }));
    }
})();

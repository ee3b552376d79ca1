// Reads names of files from standard input, one per line, and writes a line of JSON for each: the codes of the validator's errors.
const fs = require('fs');
const path = require('path');
const validator = require(process.argv[2]);

async function validate(file) {
  try {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
      maxIssues: 0, externalResourceFunction: (uri) => new Promise((resolve, reject) => {
        try { resolve(new Uint8Array(fs.readFileSync(path.resolve(path.dirname(file), decodeURIComponent(uri))))); } catch (e) { reject(String(e)); }
      })});
    const codes = (severity) => [...new Set(report.issues.messages.filter((m) => m.severity === severity).map((m) => m.code))];
    return {file, errors: codes(0), warnings: codes(1)};
  } catch (e) { return {file, errors: ['THROWN: ' + String(e).split('\n')[0]], warnings: []}; }
}

// For some files the validator throws an exception: that is then its verdict, and the next file follows.
let giveUp = () => {};
for (const event of ['uncaughtException', 'unhandledRejection'])
  process.on(event, () => giveUp('THROWN: not caught'));

(async () => {
  for (const file of fs.readFileSync(0, 'utf8').split('\n').filter((line) => line)) {
    const thrown = new Promise((resolve) => { giveUp = (why) => resolve({file, errors: [why], warnings: []}); });
    console.log(JSON.stringify(await Promise.race([validate(file), thrown])));
  }
  process.exit(0);
})();

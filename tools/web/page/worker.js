// The renderer, in a thread other than the page's. A message {number, question, file?} is answered by {number, answer, arrays}.
importScripts("strata.js", "interface.js");

const ready = load();

onmessage = async ({ data }) => {
  const strata = await ready;
  if (data.file) strata.addFile(data.file.name, data.file.bytes);
  const { answer, arrays } = strata.ask(data.question);
  postMessage({ number: data.number, answer, arrays }, Object.values(arrays).map((array) => array.buffer));
};

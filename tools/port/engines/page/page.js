// Loads the job, renders it with its engine, and sends the results to the server. job_of of web.py writes /job.json.

// A framebuffer's pixels in the form for the server; the bottom row is first. `element` is u1 or f4.
export async function send(name, gl, width, height, element, channels = 4) {
    const pixels = element === 'u1' ? new Uint8Array(4 * width * height) : new Float32Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, element === 'u1' ? gl.UNSIGNED_BYTE : gl.FLOAT, pixels);
    const error = gl.getError();
    if (error) throw new Error(`${name}: readPixels ended with error ${error}`);
    const kept = channels === 4 ? pixels : pixels.filter((_, i) => i % 4 < channels);
    await post(name, width, height, channels, element, kept);
}

// Rows of numbers, the bottom row first.
export async function post(name, width, height, channels, element, pixels) {
    await fetch(`/target?name=${name}&width=${width}&height=${height}&channels=${channels}&element=${element}`, { method: 'POST', body: pixels });
}

// One job; the page is loaded again for the next one, so that engines do not affect each other.
async function run() {
    const job = await (await fetch('/job.json')).json();
    const canvas = document.getElementById('canvas');
    canvas.width = job.width;
    canvas.height = job.height;
    canvas.style.width = `${job.width}px`;  // engines read the size of the element
    canvas.style.height = `${job.height}px`;
    const driver = await import(`/page/${job.engine}.js`);
    if (job.camera) {
        const { view, projection } = driver.matrices(job.camera, job.width, job.height, canvas);
        await fetch('/camera', { method: 'POST', body: JSON.stringify({ view: Array.from(view), projection: Array.from(projection) }) });
    } else {
        await driver.draw(job, canvas);
    }
    await end('/done', '');
}

async function end(path, body) {
    await fetch(path, { method: 'POST', body });
    location.reload();
}

// A plain Error is a sentence of a driver; all others are reported with their source lines.
const fail = error => end('/failed', error?.constructor === Error ? error.message : String(error?.stack ?? error));
window.addEventListener('unhandledrejection', event => fail(event.reason));
run().catch(fail);

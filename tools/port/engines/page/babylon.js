// Babylon.js, WebGL2 engine. Ways: `oit` (scene.useOrderIndependentTransparency, its dual depth peeling; peels are passCount) and
// `blended`, without that option. With targets: every target after every pass, with the names of a pack's `dual`.
import { Engine } from '@babylonjs/core/Engines/engine.js';
import { Scene } from '@babylonjs/core/scene.js';
import { Mesh } from '@babylonjs/core/Meshes/mesh.js';
import { VertexData } from '@babylonjs/core/Meshes/mesh.vertexData.js';
import { FreeCamera } from '@babylonjs/core/Cameras/freeCamera.js';
import { StandardMaterial } from '@babylonjs/core/Materials/standardMaterial.js';
import { Matrix, Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { Color3, Color4 } from '@babylonjs/core/Maths/math.color.js';
import '@babylonjs/core/Engines/AbstractEngine/abstractEngine.alpha.js';
import '@babylonjs/core/Engines/Extensions/engine.multiRender.js';
import '@babylonjs/core/Rendering/prePassRendererSceneComponent.js';
import '@babylonjs/core/Shaders/oitFinal.fragment.js';  // depthPeelingRenderer.js, line 48, uses it and does not import it
import '@babylonjs/core/Rendering/depthPeelingSceneComponent.js';
import { post, send } from '/page/page.js';

function add_mesh(mesh, scene) {
    const made = new Mesh(mesh.name, scene);
    const data = new VertexData();
    data.positions = new Float32Array(mesh.positions);
    data.colors = new Float32Array(mesh.colors);
    data.indices = new Uint32Array(mesh.triangles);
    data.applyToMesh(made);
    const material = new StandardMaterial(mesh.name, scene);
    material.disableLighting = true;
    material.emissiveColor = Color3.White();  // times the vertex colour
    material.backFaceCulling = false;
    made.material = material;
    made.useVertexColors = true;
    made.hasVertexAlpha = !mesh.opaque;
    made.alwaysSelectAsActiveMesh = true;
    made.freezeWorldMatrix(Matrix.FromArray(mesh.model));
}

// Babylon multiplies row vectors by matrices, so that their layout in memory is OpenGL's.
function add_camera(job, scene) {
    const camera = new FreeCamera('camera', Matrix.FromArray(job.view).invert().getTranslation(), scene);  // meshes are sorted by their distance
    camera._getViewMatrix = () => Matrix.FromArray(job.view);
    camera.freezeProjectionMatrix(Matrix.FromArray(job.projection));
    scene.activeCamera = camera;
}

export function matrices({ eye, center, up, fovy_degrees, near, far }, width, height, canvas) {
    [canvas.width, canvas.height] = [width, height];
    const scene = new Scene(new Engine(canvas));
    scene.useRightHandedSystem = true;  // before the camera is made; Babylon's default looks along +z
    const camera = new FreeCamera('camera', new Vector3(...eye), scene);
    camera.upVector = new Vector3(...up);
    camera.setTarget(new Vector3(...center));
    [camera.fov, camera.minZ, camera.maxZ] = [fovy_degrees * Math.PI / 180, near, far];
    return { view: camera.getViewMatrix().asArray(), projection: camera.getProjectionMatrix().asArray() };
}

// The peel's textures are created while frames are drawn, so that frames are drawn until all exist.
async function render_until_ready(scene, job) {
    const is_ready = () => scene.isReady() && (job.way !== 'oit' || scene.depthPeelingRenderer.isReady());
    for (let frame = 0; !is_ready(); ++frame) {
        if (frame === 600) throw new Error('the scene was not ready after 600 frames');
        scene.render();
        await new Promise(resolve => setTimeout(resolve, 20));
    }
}

// Reads a texture's first level as f4, for every format.
function read_texture(gl, texture, width, height, channels) {
    const framebuffer = gl.createFramebuffer();
    const bound = gl.getParameter(gl.READ_FRAMEBUFFER_BINDING);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, framebuffer);
    gl.framebufferTexture2D(gl.READ_FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    const pixels = new Float32Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, pixels);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, bound);
    gl.deleteFramebuffer(framebuffer);
    return channels === 4 ? pixels : pixels.filter((_, i) => i % 4 < channels);
}

// Stores every target after every pass of the next frame. A geometry pass ends with _renderSubMeshes, a full-screen pass with the effect
// renderer's render (thinDepthPeelingRenderer.pure.js, 409, 441 and 453).
function watch(peeling, gl, job) {
    const kept = [];
    let passes = 0;
    const keep = () => {
        const number = String(passes++).padStart(3, '0');
        const textures = peeling._thinTextures;
        const layer = 1 - peeling._currentPingPongState;  // the side that is written
        // Depth, front and back of one side of the ping-pong, the same of the other, and the target into which the back is blended (_createTextures).
        const targets = { 'min_max': [textures[0], 2], 'front': [textures[1], 4], 'min_max.1': [textures[3], 2], 'front.1': [textures[4], 4],
                          'back_layer': [textures[3 * layer + 2], 4], 'back': [textures[6], 4] };
        for (const [name, [texture, channels]] of Object.entries(targets)) {
            const pixels = read_texture(gl, texture._texture._hardwareTexture.underlyingResource, job.width, job.height, channels);
            kept.push({ name: `pass.${number}/${name}`, channels, pixels });
        }
    };
    const draw_meshes = peeling._renderSubMeshes.bind(peeling);
    peeling._renderSubMeshes = meshes => { draw_meshes(meshes); keep(); };
    const draw_screen = peeling._effectRenderer.render.bind(peeling._effectRenderer);
    peeling._effectRenderer.render = (wrapper, ...rest) => {
        draw_screen(wrapper, ...rest);
        if (wrapper !== peeling._finalEffectWrapper) keep();
    };
    return kept;
}

export async function draw(job, canvas) {
    const engine = new Engine(canvas, false, { preserveDrawingBuffer: true, stencil: false });
    const scene = new Scene(engine);
    scene.useRightHandedSystem = true;
    scene.clearColor = new Color4(...job.background, 1);
    add_camera(job, scene);
    job.meshes.forEach(mesh => add_mesh(mesh, scene));
    if (job.way === 'oit') {
        scene.useOrderIndependentTransparency = true;
        if (job.peels !== null) scene.depthPeelingRenderer.passCount = job.peels;
    }
    await render_until_ready(scene, job);
    const gl = engine._gl;
    const kept = job.targets ? watch(scene.depthPeelingRenderer, gl, job) : [];
    scene.render();
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    for (const { name, channels, pixels } of kept) await post(name, job.width, job.height, channels, 'f4', pixels);
    await send('picture', gl, job.width, job.height, 'u1');
}

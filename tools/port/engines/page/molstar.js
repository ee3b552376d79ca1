// Mol*: its DrawPass without a plugin. Ways: `dpoit` (dual depth peeling; peels are its iterations), `wboit`, `blended`.
// Colours are uniforms of 8 bits per channel (mol-util/color), alpha is a float; a mesh has one of each.
import { ValueCell } from 'molstar/mol-util/index.js';
import { Color } from 'molstar/mol-util/color/index.js';
import { Mat4, Vec3 } from 'molstar/mol-math/linear-algebra.js';
import { Mesh } from 'molstar/mol-geo/geometry/mesh/mesh.js';
import { createRenderObject } from 'molstar/mol-gl/render-object.js';
import { createContext, getGLContext } from 'molstar/mol-gl/webgl/context.js';
import { Renderer } from 'molstar/mol-gl/renderer.js';
import { Scene } from 'molstar/mol-gl/scene.js';
import { Camera } from 'molstar/mol-canvas3d/camera.js';
import { DrawPass } from 'molstar/mol-canvas3d/passes/draw.js';
import { PostprocessingParams } from 'molstar/mol-canvas3d/passes/postprocessing.js';
import { MarkingParams } from 'molstar/mol-canvas3d/passes/marking.js';
import { ParamDefinition as PD } from 'molstar/mol-util/param-definition.js';
import { send } from '/page/page.js';

const ITERATIONS = 2;  // canvas3d.js, dpoitIterations

// Color.fromNormalizedRgb truncates to 8 bits (mol-util/color/color.js 48): 148 / 255 of a binary32 becomes 147.
const color_of = rgb => Color.fromRgb(...rgb.slice(0, 3).map(c => Math.round(255 * c)));

function world_positions(mesh) {
    const positions = new Float32Array(mesh.positions);
    const model = Mat4.fromArray(Mat4(), mesh.model, 0);
    for (let i = 0; i < positions.length; i += 3) {
        const [x, y, z] = positions.subarray(i, i + 3);
        for (let k = 0; k < 3; ++k) positions[i + k] = model[k] * x + model[4 + k] * y + model[8 + k] * z + model[12 + k];
    }
    return positions;
}

function object_of(mesh, material_id) {
    if (!mesh.flat) throw new Error(`${mesh.name}: expected one colour and alpha a triangle, for a mesh of Mol* has one alpha`);
    const vertices = mesh.positions.length / 3;
    const shape = Mesh.create(world_positions(mesh), new Uint32Array(mesh.triangles), new Float32Array(3 * vertices).fill(0.577),
        new Float32Array(vertices), vertices, mesh.triangles.length / 3);
    const props = { ...PD.getDefaultValues(Mesh.Params), alpha: mesh.opaque ? 1 : mesh.flat[3], ignoreLight: true, doubleSided: true, transparentBackfaces: 'on',
                    interior: { color: Color(0), colorStrength: 0, substance: { metalness: 0, roughness: 0, bumpiness: 0 }, substanceStrength: 0 } };  // its own mixes grey into back faces
    const values = Mesh.Utils.createValuesSimple(shape, props, color_of(mesh.flat), 1);
    return createRenderObject('mesh', values, Mesh.Utils.createRenderableState(props), material_id);
}

function camera_of(job) {
    const camera = new Camera({ ...Camera.createDefaultSnapshot(), fog: 0 }, { x: 0, y: 0, width: job.width, height: job.height });
    Mat4.fromArray(camera.view, job.view, 0);
    Mat4.fromArray(camera.projection, job.projection, 0);
    Mat4.mul(camera.projectionView, camera.projection, camera.view);
    return camera;
}

export function matrices({ eye, center, up, fovy_degrees, near, far }, width, height) {
    const forward = Vec3.normalize(Vec3(), Vec3.sub(Vec3(), center, eye));
    const camera = new Camera({ ...Camera.createDefaultSnapshot(), position: Vec3.clone(eye), up: Vec3.clone(up), fov: fovy_degrees * Math.PI / 180,
        target: Vec3.scaleAndAdd(Vec3(), eye, forward, (near + far) / 2), radius: (far - near) / 2, radiusMax: (far - near) / 2, clipFar: true, minNear: 0 },
        { x: 0, y: 0, width, height });
    camera.update();
    return { view: [...camera.view], projection: [...camera.projection] };
}

function settings_of(job) {
    const off = { name: 'off', params: {} };
    const postprocessing = { ...PD.getDefaultValues(PostprocessingParams), occlusion: off, shadow: off, outline: off, antialiasing: off, dof: off, sharpening: off, bloom: off };
    return { postprocessing, marking: { ...PD.getDefaultValues(MarkingParams), enabled: false }, transparentBackground: false,
             dpoitIterations: job.peels ?? ITERATIONS };
}

export async function draw(job, canvas) {
    const gl = getGLContext(canvas, { alpha: true, antialias: false, depth: true, preserveDrawingBuffer: true, premultipliedAlpha: true });
    const webgl = createContext(gl);
    const way = job.way === 'dpoit' || job.way === 'wboit' ? job.way : 'blended';
    const scene = Scene.create(webgl, way);
    job.meshes.forEach((mesh, i) => scene.add(object_of(mesh, i)));
    scene.commit();
    scene.update(undefined, false);
    const renderer = Renderer.create(webgl, { backgroundColor: color_of(job.background) });
    const pass = new DrawPass(webgl, { }, job.width, job.height, way);
    if (pass.transparency !== way) throw new Error(`expected transparency ${way}, found ${pass.transparency}`);
    webgl.resources.linkPrograms();
    webgl.resources.finalizePrograms(undefined, true);
    const none = { isEnabled: false };
    const helper = { debug: none, handle: none, pointer: none, camera: none };
    pass.render({ renderer, camera: camera_of(job), scene, helper }, settings_of(job), true);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    await send('picture', gl, job.width, job.height, 'u1');
}

// three.js, WebGLRenderer. Ways: `blended`, a transparent material with its defaults, which writes depth; `no-depth-write`, the same with
// depthWrite = false; `float`, no-depth-write into a target of binary32, without the canvas's 8 bits and its sRGB encoding.
import * as THREE from 'three';
import { send } from '/page/page.js';

// three.js treats vertex colours as linear and encodes them again for the canvas; a float target stores them unchanged.
function colors_of(mesh, way) {
    const colors = new Float32Array(mesh.colors);
    if (way === 'float') return colors;
    const color = new THREE.Color();
    for (let i = 0; i < colors.length; i += 4) {
        color.setRGB(colors[i], colors[i + 1], colors[i + 2], THREE.SRGBColorSpace).toArray(colors, i);
    }
    return colors;
}

function object_of(mesh, way) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(mesh.positions), 3));
    geometry.setAttribute('color', new THREE.BufferAttribute(colors_of(mesh, way), 4));
    geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(mesh.triangles), 1));
    const material = new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.DoubleSide, transparent: !mesh.opaque, toneMapped: false });
    if (!mesh.opaque && way !== 'blended') material.depthWrite = false;
    const object = new THREE.Mesh(geometry, material);
    object.frustumCulled = false;
    object.matrixAutoUpdate = false;
    object.matrix.fromArray(mesh.model);
    return object;
}

function camera_of(job) {
    const camera = new THREE.Camera();
    camera.matrixAutoUpdate = false;
    camera.matrixWorldInverse.fromArray(job.view);
    camera.matrix.copy(camera.matrixWorldInverse).invert();
    camera.updateMatrixWorld = () => {};  // it would invert the inverse again
    camera.matrixWorld.copy(camera.matrix);
    camera.projectionMatrix.fromArray(job.projection);
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
    return camera;
}

export function matrices({ eye, center, up, fovy_degrees, near, far }, width, height) {
    const camera = new THREE.PerspectiveCamera(fovy_degrees, width / height, near, far);
    camera.position.set(...eye);
    camera.up.set(...up);
    camera.lookAt(...center);
    camera.updateMatrixWorld();
    return { view: camera.matrixWorldInverse.elements, projection: camera.projectionMatrix.elements };
}

export async function draw(job, canvas) {
    const renderer = new THREE.WebGLRenderer({ canvas, antialias: false, preserveDrawingBuffer: true });
    renderer.setPixelRatio(1);
    renderer.setSize(job.width, job.height, false);
    const scene = new THREE.Scene();
    scene.add(...job.meshes.map(mesh => object_of(mesh, job.way)));
    const is_float = job.way === 'float';
    renderer.setClearColor(new THREE.Color().setRGB(...job.background, is_float ? THREE.LinearSRGBColorSpace : THREE.SRGBColorSpace), 1);
    const gl = renderer.getContext();
    if (is_float) {
        if (!gl.getExtension('EXT_float_blend')) throw new Error('expected EXT_float_blend');
        renderer.setRenderTarget(new THREE.WebGLRenderTarget(job.width, job.height, { type: THREE.FloatType }));
    }
    renderer.render(scene, camera_of(job));
    await send('picture', gl, job.width, job.height, is_float ? 'f4' : 'u1');
}

// The viewer of `lekalo export --format html`: shows the glTF model that the page holds. Bundled into viewer.js:
//
//   npm install three@0.187.0 esbuild && npx esbuild viewer.mjs --bundle --minify --legal-comments=eof --outfile=viewer.js
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { RoomEnvironment } from 'three/examples/jsm/environments/RoomEnvironment.js';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setPixelRatio(window.devicePixelRatio);
document.body.appendChild(renderer.domElement);

const scene = new THREE.Scene();
scene.background = new THREE.Color('white');
const light = new THREE.PMREMGenerator(renderer);
scene.environment = light.fromScene(new RoomEnvironment(), 0.04).texture;

const camera = new THREE.PerspectiveCamera(30, 1, 0.001, 1000);
const controls = new OrbitControls(camera, renderer.domElement);

function show() {
  renderer.render(scene, camera);
}

function resize() {
  renderer.setSize(window.innerWidth, window.innerHeight);
  camera.aspect = window.innerWidth / window.innerHeight;
  camera.updateProjectionMatrix();
  show();
}

// From in front, a little from the right and above, as far as the whole model needs.
function frame(model) {
  const ball = new THREE.Box3().setFromObject(model).getBoundingSphere(new THREE.Sphere());
  const radius = ball.radius || 1;
  const distance = radius / Math.sin((camera.fov / 2) * Math.PI / 180);
  camera.near = distance / 100;
  camera.far = distance * 100;
  camera.position.copy(ball.center).addScaledVector(new THREE.Vector3(0.5, 0.5, 0.8).normalize(), 1.05 * distance);
  controls.target.copy(ball.center);
  controls.update();
}

const text = document.getElementById('lekalo-model').textContent;
const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
new GLTFLoader().parse(bytes.buffer, '', (gltf) => {
  scene.add(gltf.scene);
  frame(gltf.scene);
  controls.addEventListener('change', show);
  window.addEventListener('resize', resize);
  resize();
  let triangles = 0, lines = 0;
  gltf.scene.traverse((one) => {
    if (one.isMesh) triangles += one.geometry.index.count / 3;
    if (one.isLine) lines += 1;
  });
  document.body.dataset.lekalo = `${triangles} triangles, ${lines} lines`;
}, (error) => { document.body.textContent = `The model cannot be shown: ${error}`; });

// What `smash export` writes opens in three.js, and moves there as the table says.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { AnimationMixer, Matrix4, Quaternion, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { folder, ROOT, smash } from './browser.mjs';

/** The film of a scene, the rows of its table, and which way is up. */
async function exported(name) {
  const scene = join(ROOT, 'scenes', `${name}.json`);
  smash('reconstruct', scene, '-o', 'result.json');
  smash('export', 'result.json', '-o', 'film.glb');
  smash('export', 'result.json', '-o', 'table.csv', '--fps', '500');
  const film = await new GLTFLoader().parseAsync(
    new Uint8Array(readFileSync(join(folder, 'film.glb'))).buffer,
    '',
  );
  const [header, ...lines] = readFileSync(join(folder, 'table.csv'), 'utf8').trim().split('\n');
  const names = header.split(',');
  const rows = lines.map((line) =>
    Object.fromEntries(line.split(',').map((cell, index) => [names[index], cell])),
  );
  const up = JSON.parse(readFileSync(scene, 'utf8')).up ?? [0, 1, 0];
  return { film, rows, up: new Vector3(...up) };
}

for (const name of ['boxes', 'uneven_times', 'ball_on_floor', 'box_on_floor']) {
  test(`the film of ${name} moves in three.js as its table says`, async () => {
    const { film, rows, up } = await exported(name);
    const first = Math.min(...rows.map((row) => Number(row.time_s)));
    assert.equal(film.animations.length, 1);
    const [clip] = film.animations;
    const mixer = new AnimationMixer(film.scene);
    mixer.clipAction(clip).play();
    // From the scene's world to that of three.js, where +y is up.
    const upright = new Matrix4().makeRotationFromQuaternion(
      new Quaternion().setFromUnitVectors(up, new Vector3(0, 1, 0)),
    );
    for (const row of rows) {
      const numbers = (parts) => parts.map((part) => Number(row[part]));
      // The clip's end is its start again.
      mixer.setTime(Math.min(Number(row.time_s) - first, clip.duration - 1e-6));
      film.scene.updateMatrixWorld(true);
      const turn = new Quaternion();
      if (row.orientation_w !== '') {
        turn.set(...numbers(['orientation_x', 'orientation_y', 'orientation_z', 'orientation_w']));
      }
      const at = new Vector3(...numbers(['position_x_m', 'position_y_m', 'position_z_m']));
      const expected = new Matrix4().compose(at, turn, new Vector3(1, 1, 1)).premultiply(upright);
      const body = film.scene.getObjectByName(row.body);
      // The centre, and points a metre off, which show turning: gravity bends the way between two keys
      // by 0.34 mm, and tumbling turns a metre by up to 1.3 mm.
      for (const point of [new Vector3(), new Vector3(1, 0, 0), new Vector3(0, 0, 1)]) {
        const found = point.clone().applyMatrix4(body.matrixWorld);
        const apart = found.distanceTo(point.applyMatrix4(expected));
        assert.ok(apart < 2e-3, `${row.body} at ${row.time_s} s is ${apart} m off`);
      }
    }
  });
}

test('what a film tells of its scene is there in three.js', async () => {
  const { film } = await exported('boxes');
  const { scene, mass_ratio: massRatio, collision_s: collision } = film.scene.userData;
  assert.equal(scene, 'two boxes in mid-air');
  assert.ok(Math.abs(massRatio - 1.8) < 0.05);
  for (const track of film.animations[0].tracks) {
    assert.equal(track.times.filter((time) => Math.abs(time - collision) < 1e-6).length, 1, track.name);
  }
});

// The report, opened from disk with the network off.

import assert from 'node:assert/strict';
import { readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { changed, dataOf, folder, launch, open, scene, smash, until } from './browser.mjs';

let browser;
let report;

before(async () => {
  const thrown = scene('thrown_ball_drag');
  smash('reconstruct', thrown, '-o', 'base.json');
  smash('reconstruct', thrown, '--with', 'quadratic_drag@ball', '-o', 'drag.json');
  report = join(folder, 'report.html');
  smash('report', thrown, 'base.json', 'drag.json', '-o', report);
  browser = await launch();
});
after(() => browser?.close());

/** Opens the report, does something, and wants no error on the console. */
async function looked(file, act, options) {
  const { page, errors, close } = await open(browser, file, options);
  await act(page);
  assert.deepEqual(errors, []);
  await close();
}

const timeOf = (page) => page.getByTestId('time').textContent();
const secondsOf = async (page) => parseFloat(await timeOf(page));

test('the first glance says what this is, that the model misses, and what is missing', () =>
  looked(report, async (page) => {
    assert.ok(statSync(report).size < 1_500_000);
    assert.equal(await page.locator('h1').textContent(), 'a light ball, thrown on a floor');
    const verdict = await page.getByTestId('verdict').textContent();
    assert.match(verdict, /misses the measured poses by more than noise: 7\.1\d mm/);
    assert.match(verdict, /quadratic_drag@ball is missing/);
    assert.match(await page.getByTestId('key-numbers').textContent(), /restitution0\.6\d+ ± 0\.000\d+/);
    assert.match(await page.getByTestId('candidates').textContent(), /quadratic_drag@ball> 0\.999/);
    assert.match(await page.getByTestId('ladder').textContent(), /\+ quadratic_drag@ball/);
    assert.match(await page.getByTestId('advice').textContent(), /smash reconstruct/);
    assert.match(await page.getByTestId('estimates').textContent(), /restitution c/);
    assert.match(await page.getByTestId('ledger').textContent(), /energy of the motion/);
  }));

test('3D is drawn, and moves with the slider', () =>
  looked(report, async (page) => {
    const canvas = page.getByTestId('stage-canvas');
    const first = await colours(page);
    assert.ok(first.size > 20, `only ${first.size} colours`);
    const before = await canvas.screenshot();
    const slider = page.getByTestId('time-slider');
    await slider.fill('120');
    const early = await secondsOf(page);
    assert.match(await timeOf(page), /ms before the impact/);
    await until(
      () => canvas.screenshot(),
      (now) => !now.equals(before),
      'the picture',
    );
    await slider.focus();
    await page.keyboard.press('ArrowRight');
    const later = await secondsOf(page);
    assert.ok(later > early && later < early + 0.01, `${early} to ${later}`);
    await page.getByTestId('impact').click();
    assert.match(await timeOf(page), /the impact$/);
    await page.getByTestId('step-on').click();
    assert.equal(await secondsOf(page), 0.45);
    await page.getByTestId('step-back').click();
    assert.equal(await secondsOf(page), 0.4);
  }));

/** The colours in the picture, read from the still one that is made for paper. */
async function colours(page) {
  const found = await page.evaluate(() => {
    window.dispatchEvent(new Event('beforeprint'));
    const still = document.querySelector('.stage-still');
    const { data } = still.getContext('2d').getImageData(0, 0, still.width, still.height);
    return [...new Set(new Uint32Array(data.buffer))];
  });
  return new Set(found);
}

test('play runs at the chosen speed, and space pauses it', () =>
  looked(report, async (page) => {
    await page.getByTestId('time-slider').fill('0');
    await page.getByTestId('speed').selectOption('0.1');
    await page.locator('h1').click();
    await page.keyboard.press('Space');
    await until(
      () => secondsOf(page),
      (now) => now > 0.02,
      'the time',
    );
    await page.keyboard.press('Space');
    const stopped = await secondsOf(page);
    await page.waitForTimeout(200);
    assert.equal(await secondsOf(page), stopped);
    assert.match(await page.getByTestId('play').textContent(), /Play/);
  }));

test('the cursor in a plot moves the time in 3D, and the other way round', () =>
  looked(report, async (page) => {
    const plot = page.locator('[data-key="ball/along_velocity"] .u-over');
    const box = await plot.boundingBox();
    await page.mouse.move(box.x + 0.25 * box.width, box.y + box.height / 2);
    const hovered = await secondsOf(page);
    assert.ok(hovered > 0.1 && hovered < 0.3, `${hovered}`);
    const place = () =>
      page
        .getByTestId('plot-cursor')
        .evaluateAll((all) => all.map((one) => Math.round(one.getBoundingClientRect().x)));
    const there = await place();
    assert.ok(there.length >= 3 && new Set(there).size === 1, `${there}`);
    assert.ok(Math.abs(there[0] - (box.x + 0.25 * box.width)) < 3);
    await page.getByTestId('impact').click();
    assert.ok((await place())[0] > there[0] + 50);
    const readout = page.locator('[data-key="ball/along_velocity"] .plot-readout');
    assert.match(await readout.textContent(), /pose 16 at 0\.4000 s: .* mm \(.* σ\)/);
  }));

test('every plot says what it shows and how to read it', () =>
  looked(report, async (page) => {
    const plots = page.getByTestId('residual-plot');
    assert.equal(await plots.count(), 4);
    for (const text of await plots.allTextContents()) {
      assert.match(text, /ball, .*mm/);
      assert.match(text, /Measured minus model\. Above zero: ball is .* Grey: ±2 σ/);
    }
    assert.match(await plots.first().textContent(), /Drift of 11 σ before/);
  }));

test('results stand side by side, and one chooses which is drawn', () =>
  looked(report, async (page) => {
    const table = await page.getByTestId('side-by-side').textContent();
    assert.match(table, /base\.json.*drag\.json.*difference/);
    assert.match(table, /7\.1\d mm0\.98\d mm/);
    const before = await page.getByTestId('stage-canvas').screenshot();
    await page.getByTestId('model-1').check();
    assert.match(await page.getByTestId('verdict').textContent(), /meets the measured poses to their noise/);
    assert.match(
      await page.getByTestId('effects').textContent(),
      /quadratic_drag@ballk0\.11\d+ ± 0\.001\d+1\/m/,
    );
    assert.match(await page.getByTestId('residual-plot').first().textContent(), /Like noise/);
    assert.match(await timeOf(page), /the impact$/);
    await until(
      () => page.getByTestId('stage-canvas').screenshot(),
      (now) => !now.equals(before),
      'the picture',
    );
  }));

test('side by side, differences have their sign, and as many digits as the least deviation', async () => {
  const number = (value, std) => ({ value: [value], std: [std] });
  const file = changed(report, 'digits.html', (data) => {
    data.quantities = [
      {
        quantity: 'restitution',
        unit: '',
        difference_unit: '',
        entries: [number(0.61012, 0.02), number(0.60998, 0.00015)],
        differences: [{ difference: [-0.00014], size: 0.00014, in_sigma: 0.007 }],
      },
      {
        quantity: 'collision_time',
        unit: 's',
        difference_unit: 's',
        entries: [number(0.4, null), number(0.4012, null)],
        differences: [{ difference: [0.0012], size: 0.0012, in_sigma: null }],
      },
      {
        quantity: 'ball.orientation',
        unit: '',
        difference_unit: 'rad',
        entries: [
          { value: [1, 0, 0, 0], std: [0.01, 0.01, 0.01] },
          { value: [0.99995, 0.01, 0, 0], std: [0.01, 0.01, 0.01] },
        ],
        differences: [{ difference: [0.02, 0, 0], size: 0.02, in_sigma: 1.414 }],
      },
    ];
  });
  await looked(file, async (page) => {
    const table = await page.getByTestId('side-by-side').textContent();
    assert.match(table, /restitution c0\.61012 ± 0\.020000\.60998 ± 0\.00015−0\.00014 \(0\.0 σ\)/);
    assert.match(table, /collision time t_cs0\.40000\.4012\+0\.0012/);
    assert.match(table, /\(1\.000, 0\.010, 0\.000, 0\.000\)1\.15° \(1\.4 σ\)/);
  });
});

test('a rung names what the poses can’t tell from its effect', () =>
  looked(
    changed(report, 'alike.html', (data) => {
      const rung = data.improvement.ladder[1];
      rung.parameters = { k: { value: 0.118, std: 0.0016, unit: '1/m' } };
      rung.indistinguishable_from = ['linear_drag@ball', 'gravity_scale'];
      rung.look_alikes = [
        { effect: 'linear_drag@ball', parameters: { k: { value: 0.31, std: 0.02, unit: '1/s' } } },
      ];
    }),
    async (page) => {
      const ladder = await page.getByTestId('ladder').textContent();
      assert.ok(
        ladder.includes(
          '+ quadratic_drag@ball (k = 0.1180 ± 0.0016 1/m) ' +
            'can’t be told from linear_drag@ball (k = 0.310 ± 0.020 1/s) or gravity_scale',
        ),
        ladder,
      );
    },
  ));

test('without a diagnosis the ladder’s answer stands beside the verdict, too', () =>
  looked(
    changed(report, 'ladder.html', (data) => {
      data.diagnosis = null;
      data.models = [data.models[1]];
      data.improvement.explanation = 'The noise may be larger than stated.';
    }),
    async (page) => {
      const told = /The noise may be larger than stated\./;
      assert.match(await page.getByTestId('verdict').textContent(), told);
      assert.equal(await page.getByText(told).count(), 2, 'and with the ladder');
    },
  ));

test('the books say where the momentum of a lone body went', async () => {
  const books = (page) => page.getByRole('region', { name: 'The books' }).textContent();
  await looked(report, async (page) => {
    assert.match(await books(page), /went into what it hit: the plane, floor\./);
  });
  const unseen = changed(report, 'unseen.html', (data) => {
    data.scene.plane = null;
  });
  await looked(unseen, async (page) => {
    assert.match(await books(page), /went into what it hit: a body that isn’t in the scene\./);
  });
});

test('residuals beyond chance are no praise, though no flag is raised', () =>
  looked(
    changed(report, 'beyond.html', (data) => {
      data.models[1].is_beyond_chance = true;
      data.models[1].result.fit.reduced_chi2 = 1.44;
    }),
    async (page) => {
      await page.getByTestId('model-1').check();
      const verdict = await page.getByTestId('verdict').textContent();
      assert.match(verdict, /residuals are 1\.20 times as large as the stated noise, which is beyond chance/);
      assert.doesNotMatch(verdict, /meets/);
    },
  ));

/** What a click saves. */
async function saved(page, test) {
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    page.getByTestId(test).first().click(),
  ]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

test('numbers and plots are saved as files', () =>
  looked(report, async (page) => {
    const json = await saved(page, 'save-json');
    assert.equal(JSON.stringify(JSON.parse(json.bytes)), JSON.stringify(dataOf(report)));
    const csv = (await saved(page, 'save-csv')).bytes.toString().trim().split('\n');
    const points = dataOf(report)
      .models.flatMap((model) => model.series)
      .flatMap((series) => series.points);
    assert.equal(csv.length, points.length + 1);
    assert.match(csv[1], /^base\.json,ball,along_velocity,position,0,0,before,-0\.02\d+,m,0\.001$/);
    const svg = await saved(page, 'save-svg');
    assert.equal(svg.name, 'residuals_ball_along_its_path.svg');
    assert.match(svg.bytes.toString(), /^<\?xml[^]*<svg[^]*±2 σ = ±2\.00 mm[^]*<\/svg>/);
    assert.doesNotMatch(svg.bytes.toString(), /style=|<script/);
    for (const test of ['save-png', 'save-ladder-png', 'save-stage']) {
      assert.equal((await saved(page, test)).bytes.subarray(1, 4).toString(), 'PNG');
    }
    assert.match((await saved(page, 'save-ladder')).bytes.toString(), /held out/);
  }));

test('a poor fit is a doubt, except where the diagnosis of that model explains it', () =>
  looked(
    changed(report, 'poor.html', (data) => {
      for (const model of data.models) model.result.flags = ['poor_fit'];
    }),
    async (page) => {
      assert.equal(await page.getByTestId('flags').count(), 0);
      await page.getByTestId('model-1').check();
      await page.getByTestId('flags').waitFor();
    },
  ));

test('a restitution beyond 1 is a doubt, also where its interval reaches what can be', async () => {
  const with9 = (name, flags, interval) =>
    changed(report, name, (data) => {
      const { result } = data.models[0];
      result.restitution = { value: 9.0, std: 4.2, interval_95: interval };
      result.flags = flags;
    });
  const doubts = async (page) => (await page.getByTestId('flags').textContent()).match(/restitution/g).length;
  await looked(with9('unsure.html', [], [0.77, 17.2]), async (page) => {
    assert.match(await page.getByTestId('flags').textContent(), /the poses hardly tell it.*Mend: annotate/);
    assert.equal(await doubts(page), 1);
  });
  await looked(with9('beyond.html', ['restitution_out_of_range'], [8, 10]), async (page) => {
    assert.match(await page.getByTestId('flags').textContent(), /would gain energy/);
    assert.equal(await doubts(page), 1);
  });
});

test('the commands that make it again can be copied', () =>
  looked(report, async (page) => {
    const commands = await page.getByTestId('commands').textContent();
    assert.match(commands, /smash reconstruct .*--with quadratic_drag@ball -o drag\.json/);
    await page.getByTestId('copy-commands').click();
    await page.getByText(/Copied|Selected/).waitFor();
  }));

test('keys do what their list says', () =>
  looked(report, async (page) => {
    await page.keyboard.press('?');
    await page.getByTestId('keys').getByText('to the impact', { exact: true }).waitFor();
    await page.keyboard.press('Escape');
    await page.keyboard.press(',');
    assert.equal(await secondsOf(page), 0.4);
    await page.keyboard.press('i');
    assert.match(await timeOf(page), /the impact$/);
    const canvas = page.getByTestId('stage-canvas');
    for (const key of ['2', '3', '4', '5', '6', '7', '1', 'x']) {
      const before = await canvas.screenshot();
      await page.keyboard.press(key);
      await until(
        () => canvas.screenshot(),
        (now) => !now.equals(before),
        `the picture after ${key}`,
      );
    }
    assert.equal(await page.getByTestId('exaggeration').inputValue(), '1');
  }));

test('all that can be used is reached by Tab, and seen there', () =>
  looked(report, async (page) => {
    const wanted = await page
      .locator('button:visible, select:visible, input:visible, summary:visible')
      .count();
    const reached = new Set();
    for (let presses = 0; presses < 150; presses += 1) {
      await page.keyboard.press('Tab');
      const found = await page.evaluate(() => {
        const all = [...document.querySelectorAll('button, select, input, summary')];
        const here = document.activeElement;
        return { index: all.indexOf(here), outline: getComputedStyle(here).outlineStyle };
      });
      if (found.index < 0) continue;
      assert.notEqual(found.outline, 'none');
      reached.add(found.index);
    }
    // Of the two choices of a model the arrow keys reach the other.
    assert.equal(reached.size, wanted - 1);
  }));

test('names of strangers are text', async () => {
  const name = '</script><img src=x onerror="document.title=\'taken\'">';
  const file = changed(report, 'hostile.html', (data) => {
    data.scene.name = name;
    for (const body of data.scene.bodies) body.name = name;
    data.scene.plane.name = name;
    for (const model of data.models) {
      model.name = name;
      model.result.warnings = [name];
      for (const body of model.result.bodies) body.name = name;
      for (const series of model.series) series.body = name;
      for (const body of model.motion.bodies) body.name = name;
    }
    data.warnings = [name];
    data.diagnosis.explanation = name;
    data.commands = [name];
  });
  await looked(file, async (page) => {
    assert.equal(await page.locator('h1').textContent(), name);
    assert.equal(await page.locator('img').count(), 0);
    assert.doesNotMatch(await page.title(), /^taken/);
    assert.equal(await page.getByTestId('residual-plot').count(), 4);
    assert.doesNotMatch((await saved(page, 'save-svg')).bytes.toString(), /<img/);
  });
});

test('nothing is loaded from elsewhere, and no script but its own runs', () =>
  looked(report, async (page) => {
    const policy = await page.locator('meta[http-equiv=Content-Security-Policy]').getAttribute('content');
    assert.match(policy, /default-src 'none'; script-src 'sha256-[^']+'; style-src 'sha256-[^']+';/);
    assert.doesNotMatch(policy, /unsafe|https?:/);
    const before = await page.locator('script, link[rel=stylesheet], img, iframe').count();
    assert.equal(before, 2);
    assert.equal(await page.locator('[onclick], [onload]').count(), 0);
  }));

test('without data it says what to do', () =>
  looked(bare(), async (page) => {
    assert.match(await page.locator('main').innerText(), /holds no data.*smash report SCENE RESULT/);
  }));

/** The page as it is built. */
function bare() {
  const file = join(folder, 'bare.html');
  writeFileSync(
    file,
    readFileSync(report, 'utf8').replace(/(id="smash-data">)[^]*?(<\/script>)/, '$1"SMASH_DATA"$2'),
  );
  return file;
}

const NULLS = {
  'no collision time': (data) => {
    for (const model of data.models) {
      model.motion = null;
      model.series = [];
      model.result.collision_time = { value: null, std: null, reason: 'nothing was hit' };
      model.result.restitution = { value: null, std: null, reason: 'nothing was hit' };
      model.result.contact_point = null;
      model.result.normal = null;
      model.result.impulse = [0, 0, 0];
      Object.assign(model.residuals, {
        structure: [],
        channels: [],
        findings: [],
        outliers: [],
        position_rmse: null,
        reason: 'no motion is known',
      });
    }
  },
  'no spin, no noise, no diagnosis': (data) => {
    data.noise = null;
    data.scene.noise = null;
    data.scene.camera = null;
    data.scene.fps = null;
    data.diagnosis = null;
    data.improvement = null;
    for (const model of data.models) {
      for (const series of model.series) series.sigma = null;
      for (const body of model.motion.bodies) {
        for (const track of [body.before, body.after])
          Object.assign(track, { orientations: null, spins: null });
      }
      for (const line of model.residuals.ledger.lines) {
        for (const entry of [line.before, line.after, line.change])
          Object.assign(entry, { value: null, std: [null] });
        line.change_in_sigma = null;
      }
      Object.assign(model.result.fit, { chi2: null, reduced_chi2: null, orientation_rmse: null });
      for (const field of ['noise', 'uncertainty', 'gravity', 'intervals']) delete model.result[field];
    }
  },
  'a single pose and a single time': (data) => {
    for (const body of data.scene.bodies) body.observations = body.observations.slice(0, 1);
    data.models = data.models.slice(0, 1);
    data.models[0].motion = null;
    data.models[0].series = data.models[0].series.map((series) => ({
      ...series,
      points: series.points.slice(0, 1),
    }));
    data.models[0].result.collision_time.value = null;
    data.quantities = [];
  },
  'no results': (data) => {
    Object.assign(data, { models: [], quantities: [], diagnosis: null, improvement: null });
  },
  'no plane, no second body, another up': (data) => {
    data.scene.plane = null;
    data.scene.up = [0, 0, 1];
    for (const model of data.models) model.result.mass_ratio = null;
  },
  'something unexplained, several optima, flags': (data) => {
    Object.assign(data.diagnosis, {
      verdict: 'unknown_effect',
      candidates: [],
      advice: [],
      unexplained: [
        {
          body: 'ball',
          kind: 'acceleration',
          delta_chi2: 321,
          rms: 0.4,
          mean: [0.1, -0.3, 0],
          forms: [{ goes_with: 'the position', law: 'acceleration = "-k * p"', share: 0.93, factor: 2.1 }],
        },
      ],
    });
    data.models[0].result.flags = ['several_optima', 'not_converged', 'a_flag_of_the_future'];
    data.models[0].result.alternatives = [
      {
        differs_in: 'the segment',
        delta_chi2: 1.5,
        mass_ratio: null,
        restitution: null,
        collision_time: 0.3,
      },
    ];
  },
};

for (const [what, change] of Object.entries(NULLS)) {
  test(`it opens with ${what}`, () =>
    looked(changed(report, 'nulls.html', change), async (page) => {
      await page.getByTestId('stage').waitFor();
      assert.doesNotMatch(await page.locator('main').innerText(), /NaN|undefined|null|\[object/);
      await page.getByTestId('impact').click();
      await page.getByTestId('play').click();
      await page.getByTestId('view-follow').click();
      await page.getByTestId('exaggeration').selectOption('20');
      await page.waitForTimeout(100);
    }));
}

test('the paper’s results, balls without orientation and two boxes open as well', async () => {
  for (const [name, ...options] of [['ball_on_floor', '--preset', 'paper'], ['boxes']]) {
    const file = scene(name, (data) => {
      // Fewer poses are sooner diagnosed.
      for (const body of data.bodies)
        body.observations = body.observations?.filter((_, index) => index % 2 === 0);
    });
    smash('reconstruct', file, ...options, '-o', `${name}.result.json`);
    const page = join(folder, `${name}.html`);
    smash('report', file, `${name}.result.json`, '-o', page);
    await looked(page, async (opened) => {
      assert.doesNotMatch(await opened.locator('main').innerText(), /NaN|undefined|null|\[object/);
      assert.ok((await opened.getByTestId('residual-plot').count()) >= 4);
    });
  }
});

test('without WebGL it says so, and all else works', async () => {
  const without = await launch({ has3d: false });
  const { page, close } = await open(without, report);
  await page.getByTestId('no-webgl').waitFor();
  await page.getByTestId('time-slider').fill('0');
  assert.match(await timeOf(page), /^0\.0000 s/);
  assert.equal(await page.getByTestId('residual-plot').count(), 4);
  await close();
  await without.close();
});

test('dark is dark, light is light, and one may choose', async () => {
  const ground = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  await looked(
    report,
    async (page) => {
      assert.equal(await ground(page), 'rgb(20, 23, 27)');
      await page.getByTestId('theme').selectOption('light');
      assert.equal(await ground(page), 'rgb(255, 255, 255)');
    },
    { colorScheme: 'dark' },
  );
  await looked(report, async (page) => {
    assert.equal(await ground(page), 'rgb(255, 255, 255)');
    await page.getByTestId('theme').selectOption('dark');
    assert.equal(await ground(page), 'rgb(20, 23, 27)');
  });
});

test('a telephone needs no scrolling sideways', () =>
  looked(
    report,
    async (page) => {
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
      const stage = await page.getByTestId('stage').boundingBox();
      assert.ok(stage.width > 340 && stage.height >= 240);
    },
    { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true },
  ));

test('on paper 3D is a still picture, plots are drawn, and all is open', () =>
  looked(report, async (page) => {
    const pdf = await page.pdf({ format: 'A4', printBackground: false });
    assert.equal(pdf.subarray(0, 5).toString(), '%PDF-');
    assert.ok(await page.evaluate(() => document.querySelector('.stage-still').width > 100));
    assert.equal(await page.locator('.plot-paper svg').count(), 4);
    await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
    assert.equal(await page.locator('details:not([open])').count(), 0);
    await page.emulateMedia({ media: 'print' });
    assert.equal(await page.locator('button:visible').count(), 0);
    assert.ok(await page.locator('.stage-still').isVisible());
  }));

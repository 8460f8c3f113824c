// Laws of one's own in a browser: typed, checked, kept, put in.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { scene, until } from './browser.mjs';
import { WITH_DRAG, browser, opened, served, shows, tried } from './studio.mjs';

test('a law shows its mistake, and is put in when it is good', () =>
  tried(async (page) => {
    await page.getByTestId('law-example').click();
    const text = page.getByTestId('law-text');
    const good = await text.inputValue();
    await text.fill(good.replace('norm(v)', 'nrom(v)'));
    const mistake = await until(
      () => page.getByTestId('mistake').allTextContents(),
      (all) => all.length > 0,
      'the mistake',
    );
    assert.match(mistake[0], /\^{4}/);
    assert.match(mistake[0], /did you mean `norm`\?/);
    assert.equal(await page.getByTestId('law-put-in').isDisabled(), true);
    await text.fill(good);
    await until(() => page.getByTestId('law-put-in').isEnabled(), Boolean, 'the button');
    await page.getByTestId('law-put-in').click();
    await shows(page, WITH_DRAG);
    await page.getByTestId('remove-my_drag@ball').waitFor();
  }));

test('a law that is typed while the studio is away is there when it is back', async () => {
  const file = scene('thrown_ball_drag');
  const studio = await served(file);
  const { page, close } = await opened(studio.address);
  await studio.kill();
  await page.getByTestId('law-text').fill('name = "half');
  await page.getByTestId('banner').waitFor({ state: 'visible' });
  const again = await served(file);
  // Another address, at the same port, in the same browser.
  await page.goto(again.address);
  await until(
    () => page.evaluate(async () => (await (await fetch('api/state')).json()).draft),
    (draft) => draft === 'name = "half',
    'the draft at the server',
  );
  assert.equal(await page.getByTestId('law-text').inputValue(), 'name = "half');
  await close();
  await again.kill();
});

test('a window that is behind leaves the law that another one types', () =>
  tried(async (page, studio) => {
    const text = page.getByTestId('law-text');
    const sent = async (law) => {
      const answer = page.waitForResponse(
        (response) => response.url().endsWith('api/law') && response.request().postDataJSON().draft === law,
      );
      await text.fill(law);
      await answer;
    };
    await sent('name = "older');
    const other = await opened(studio.address);
    const posts = [];
    other.page.on('request', (request) => {
      if (request.url().endsWith('api/law')) posts.push(request.postDataJSON().draft);
    });
    const theirs = other.page.getByTestId('law-text');
    assert.equal(await theirs.inputValue(), 'name = "older');
    await other.page.route('**/api/**', (route) => route.abort('connectionrefused'));
    await other.page.getByTestId('banner').waitFor({ state: 'visible' });
    await sent('name = "newer');
    await other.page.unroute('**/api/**');
    await other.page.getByTestId('banner').waitFor({ state: 'hidden' });
    await until(
      () => theirs.inputValue(),
      (law) => law === 'name = "newer',
      'the law',
    );
    assert.deepEqual(posts, []);
    // Who takes it up is told what is wrong.
    await theirs.focus();
    await other.page.getByTestId('mistake').waitFor();
    assert.deepEqual(posts, ['name = "newer']);
    await other.close();
  }));

/** Kills a studio, types a law into its page, and starts another one of the same session. */
async function typedWhileAway(law) {
  const file = scene('thrown_ball_drag');
  const studio = await served(file);
  const { page, close } = await opened(studio.address);
  await sent(page, 'name = "first');
  await studio.kill();
  await page.getByTestId('law-text').fill(law);
  await page.getByTestId('banner').waitFor({ state: 'visible' });
  const again = await served(file);
  const draft = () => page.evaluate(async () => (await (await fetch('api/state')).json()).draft);
  return { page, again, draft, close: () => close().then(again.kill) };
}

/** Types a law, and waits until the server has it. */
async function sent(page, law) {
  const answer = page.waitForResponse(
    (response) => response.url().endsWith('api/law') && response.request().postDataJSON().draft === law,
  );
  await page.getByTestId('law-text').fill(law);
  await answer;
}

test('a law that was kept unsent is only offered where a newer one was typed', async () => {
  const { page, again, draft, close } = await typedWhileAway('name = "kept');
  // Another browser, which knows nothing of the first one's.
  const { page: other, close: closeOther } = await opened(again.address);
  await sent(other, 'name = "newer');
  await closeOther();
  await page.goto(again.address);
  const offer = page.getByTestId('draft-aside');
  await offer.waitFor();
  assert.match(await offer.textContent(), /Unsent draft from .*20\d\d.*name = "kept/);
  const text = page.getByTestId('law-text');
  assert.equal(await text.inputValue(), 'name = "newer');
  assert.equal(await draft(), 'name = "newer');
  // It is still there after the page is opened again, and what it takes the place of is put aside.
  await page.reload();
  await page.getByTestId('draft-take').click();
  await until(draft, (law) => law === 'name = "kept', 'the draft at the server');
  assert.match(await offer.textContent(), /name = "newer/);
  await page.getByTestId('draft-discard').click();
  assert.equal(await offer.count(), 0);
  assert.equal(await text.inputValue(), 'name = "kept');
  await close();
});

test('a law that another browser typed meanwhile is not overwritten by one that goes on typing', () =>
  tried(async (page, studio) => {
    await sent(page, 'name = "mine');
    await page.getByTestId('law-text').focus();
    const other = await opened(studio.address);
    await sent(other.page, 'name = "theirs');
    await page.keyboard.press('End');
    await page.keyboard.type(' and more');
    await page.getByTestId('draft-aside').waitFor();
    assert.equal(await page.getByTestId('law-text').inputValue(), 'name = "theirs');
    assert.match(await page.getByTestId('draft-aside').textContent(), /name = "mine/);
    await other.close();
  }));

test('what one session keeps is not sent to another of the same scene', async () => {
  const { page, again, close } = await typedWhileAway('name = "kept');
  const elsewhere = await served(scene('thrown_ball_drag'));
  // As at the same address: a browser keeps things by that.
  const kept = await page.evaluate(() => ({ ...localStorage }));
  const { page: other, close: closeOther } = await opened(elsewhere.address);
  await other.evaluate((all) => Object.assign(localStorage, all), kept);
  await other.reload();
  await other.getByTestId('law-verdict').getByText('Nothing typed yet.').waitFor();
  assert.equal(await other.getByTestId('law-text').inputValue(), '');
  await closeOther();
  await elsewhere.kill();
  await page.goto(again.address);
  await until(
    () => page.getByTestId('law-text').inputValue(),
    (law) => law === 'name = "kept',
    'the law',
  );
  await close();
});

test('while the studio is away one note stands beside the law', () =>
  tried(async (page, studio) => {
    await page.getByTestId('law-example').click();
    await until(() => page.getByTestId('law-put-in').isEnabled(), Boolean, 'the button');
    await studio.kill();
    await page.getByTestId('law-text').fill('name = "half');
    const verdict = page.getByTestId('law-verdict');
    await until(
      () => verdict.textContent(),
      (words) => /^Not checked: smash doesn’t answer here\./.test(words),
      'the note',
    );
    const law = page.getByRole('region', { name: 'A law of your own' });
    assert.deepEqual((await law.getByTestId('error').allTextContents()).filter(Boolean), []);
    assert.equal(await page.getByTestId('mistake').count(), 0);
  }));

test('a law is put on the body that is chosen, which stays chosen', () =>
  tried(async (page) => {
    const place = page.getByTestId('law-place');
    // Before there is a law at all.
    assert.equal(await place.inputValue(), 'a');
    await place.selectOption('b');
    await page.getByTestId('law-at-once').check();
    await page.getByTestId('law-example').click();
    await page.getByTestId('remove-my_drag@b').waitFor();
    const text = page.getByTestId('law-text');
    await text.fill((await text.inputValue()).replace('my_drag', 'my_other'));
    await page.getByTestId('remove-my_other@b').waitFor();
    assert.equal(await place.inputValue(), 'b');
    // Of the whole scene there is nothing to choose.
    await page.getByTestId('law-at-once').uncheck();
    await text.fill(
      'name = "my_wind"\nscope = "scene"\n[parameters.k]\nunit = "m/s^2"\nnull = 0.0\n[law]\nacceleration = "k * up"\n',
    );
    await until(() => page.getByTestId('law-put-in').isEnabled(), Boolean, 'the button');
    assert.equal(await place.isVisible(), false);
    await page.getByTestId('law-put-in').click();
    await page.getByTestId('remove-my_wind').waitFor();
  }, 'boxes'));

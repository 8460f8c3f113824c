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

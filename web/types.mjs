// node types.mjs
//
// Makes the types of the data, src/generated/*.ts, from the JSON Schemas that the program publishes.

import { mkdirSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join, parse } from 'node:path';
import { fileURLToPath } from 'node:url';
import { compileFromFile } from 'json-schema-to-typescript';

const here = dirname(fileURLToPath(import.meta.url));
const generated = join(here, 'src', 'generated');

mkdirSync(generated, { recursive: true });
for (const schema of readdirSync(join(here, 'schemas'))) {
  const types = await compileFromFile(join(here, 'schemas', schema), {
    additionalProperties: false,
    unreachableDefinitions: true,
    bannerComment: `// By types.mjs from schemas/${schema}.`,
  });
  writeFileSync(join(generated, `${parse(schema).name}.ts`), types);
}

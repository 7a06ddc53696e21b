// The report page: its data are in the page itself.

import {showIdentification} from './identification.js';
import {showRun} from './run.js';
import {showStudy} from './study.js';

const data = JSON.parse(document.getElementById('data').textContent);
const page = document.getElementById('page');
if (data.kind === 'study') showStudy(data, page);
else if (data.kind === 'identification') showIdentification(data, page);
else showRun(data, document.getElementById('surface').textContent, page);

// The page: its data are in it. What a live session moves comes from the program.

import {showIdentification} from './identification.js';
import {showLive} from './live.js';
import {showRun} from './run.js';
import {showStudy} from './study.js';

const data = JSON.parse(document.getElementById('data').textContent);
const page = document.getElementById('page');
if (data.kind === 'study') showStudy(data, page);
else if (data.kind === 'identification') showIdentification(data, page);
else if (data.kind === 'live') showLive(data, page);
else showRun(data, document.getElementById('surface').textContent, page);

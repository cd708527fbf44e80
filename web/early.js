// Shows the rung for a page opened as a file, or for a browser without modules: both cannot run boot.js, a module.
// Written in old JavaScript, which such browsers understand.
(function () {
  'use strict';
  var rung = location.protocol === 'file:' ? 'file' : 'noModule' in document.createElement('script') ? '' : 'old';
  if (!rung) return;
  document.addEventListener('DOMContentLoaded', function () {
    document.querySelector('section[data-rung="' + rung + '"]').hidden = false;
    document.getElementById('state').textContent = 'seastate "' + location.search.slice(1) + '"';
    document.getElementById('loading').hidden = true;
    document.getElementById('ladder').hidden = false;
    document.body.setAttribute('data-rung', rung);
  });
})();

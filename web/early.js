// Shows a failure message (a "rung" of index.html) if the page was opened as a file, or if the browser has no modules:
// neither can run boot.js, which is a module.
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

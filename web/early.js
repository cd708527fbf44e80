// For the page opened as a file, and for browsers that are too old: neither runs boot.js, which is a module. Old JavaScript.
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

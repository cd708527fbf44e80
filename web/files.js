// Opens files that the visitor chooses: the program asks for them, and gets them from the page's file input.

const input = document.getElementById('open-files');

addEventListener('seastate-choose-files', () => input.click());

input.addEventListener('change', () => {
  window.seastate?.open_files([...input.files]);
  // Without this, choosing the same file again would be no change.
  input.value = '';
});

// Records the canvas as a film while the sea moves. The program says when a film begins and ends.

const BITS_PER_SECOND = 16e6;
// The first that the browser can record. Safari records MP4 only.
const TYPES = ['video/webm;codecs=vp9', 'video/webm', 'video/mp4'];

let recorder;

// The program sends its events while it draws a frame, and can be called only after it.
const say = (text) => setTimeout(() => window.seastate?.show_message(text));

/** Offers a recorded film as a download. */
function save(parts, type) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob(parts, { type }));
  link.download = `seastate.${type.includes('mp4') ? 'mp4' : 'webm'}`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  say(`Film saved: ${link.download}`);
}

function begin() {
  const canvas = document.getElementById('sea');
  const mimeType = window.MediaRecorder && TYPES.find((type) => MediaRecorder.isTypeSupported(type));
  if (!mimeType || !canvas.captureStream) {
    say('This browser cannot record a film.');
    return;
  }
  try {
    const parts = [];
    const stream = canvas.captureStream();
    const made = new MediaRecorder(stream, { mimeType, videoBitsPerSecond: BITS_PER_SECOND });
    made.addEventListener('dataavailable', ({ data }) => data.size > 0 && parts.push(data));
    made.addEventListener('stop', () => {
      for (const track of stream.getTracks()) track.stop();
      if (parts.length > 0) save(parts, mimeType);
      else say('The film is empty: this browser recorded nothing.');
    });
    made.start();
    recorder = made;
    document.getElementById('recording').hidden = false;
  } catch (error) {
    say(`This browser cannot record a film: ${error.message}`);
  }
}

function end() {
  document.getElementById('recording').hidden = true;
  if (recorder?.state === 'recording') recorder.stop();
  recorder = undefined;
}

addEventListener('seastate-film-start', begin);
addEventListener('seastate-film-stop', end);

// The page's own texts (its start and its failures) in the visitor's language. The program has its own translations. A
// language's file, languages/page-XX.json, maps each English text to its translation and is fetched only when wanted.
// In a text, elements stand as <1>words</1>, or as <1/> if their words are the same in every language.

const LANGUAGES = new Set(['de', 'fr', 'es', 'pt', 'ja', 'zh']);
const TRANSLATED = 'h2, p, summary, button';
const ATTRIBUTES = ['aria-label', 'alt'];

const wanted = new URLSearchParams(location.search).get('lang') ?? 'auto';
const language = (wanted === 'auto' ? navigator.language : wanted).slice(0, 2).toLowerCase();

let words = {};

/** The translation of an English text, with values in its places, such as {done}. */
window.seastateWords = (english, places = {}) =>
  Object.entries(places).reduce((text, [name, value]) => text.replace(`{${name}}`, value), words[english] ?? english);

/** The English text of an element, in which its child elements are numbered. */
function template(element) {
  let number = 0;
  const parts = [...element.childNodes].map((node) => {
    if (node.nodeType === Node.TEXT_NODE) return node.data;
    if (node.nodeType !== Node.ELEMENT_NODE) return '';
    number += 1;
    return node.localName === 'code' ? `<${number}/>` : `<${number}>${node.textContent}</${number}>`;
  });
  return parts.join('').replace(/\s+/g, ' ').trim();
}

/** Gives an element the text of a translation, around the child elements that it has. */
function fill(element, text) {
  const children = [...element.children];
  const parts = text.split(/<(\d+)(?:\/|>([^<]*)<\/\d+)>/);
  const nodes = [];
  for (let i = 0; i < parts.length; i += 3) {
    nodes.push(parts[i]);
    const child = children[parts[i + 1] - 1];
    if (!child) continue;
    if (parts[i + 2] !== undefined) child.textContent = parts[i + 2];
    nodes.push(child);
  }
  element.replaceChildren(...nodes);
}

async function translate() {
  const response = await fetch(`languages/page-${language}.json`);
  if (!response.ok) return;
  words = await response.json();
  for (const element of document.querySelectorAll(TRANSLATED)) {
    const text = words[template(element)];
    if (text) fill(element, text);
  }
  for (const name of ATTRIBUTES) {
    for (const element of document.querySelectorAll(`[${name}]`)) {
      const text = words[element.getAttribute(name)];
      if (text) element.setAttribute(name, text);
    }
  }
  document.documentElement.lang = language;
  dispatchEvent(new Event('seastate-words'));
}

// Without the file, the page stays English.
if (LANGUAGES.has(language)) translate().catch(() => {});

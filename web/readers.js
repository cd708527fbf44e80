// The panel for screen readers: a canvas is a picture to them, so its widgets are mirrored in elements once somebody asks.
// The program describes its widgets (src/app/screen_readers.rs); what is done to the elements goes back to it.

const EVERY_MS = 200;

const TEXTS = new Set(['Label', 'Heading', 'Paragraph']);

// What stands for a widget: the element, and how it follows.
function mirrorOf(item, sea) {
  const button = (role) => {
    const element = document.createElement('button');
    element.type = 'button';
    if (role) element.setAttribute('role', role);
    element.addEventListener('click', () => sea.act(item.id, 'click', 0, ''));
    return element;
  };
  const input = (type) => {
    const element = document.createElement('input');
    element.type = type;
    return element;
  };
  if (TEXTS.has(item.role)) return document.createElement('p');
  if (item.now !== undefined) {
    const slider = item.role === 'Slider';
    const element = input(slider ? 'range' : 'number');
    // Keys move it as they move the slider itself, whose scale may be logarithmic.
    element.addEventListener('keydown', (event) => {
      const way = { ArrowRight: 'more', ArrowUp: 'more', ArrowLeft: 'less', ArrowDown: 'less' }[event.key];
      if (!slider || !way) return;
      event.preventDefault();
      sea.act(item.id, way, 0, '');
    });
    element.addEventListener(slider ? 'input' : 'change', () => {
      const value = element.valueAsNumber;
      if (Number.isFinite(value)) sea.act(item.id, 'set', value, '');
    });
    return element;
  }
  switch (item.role) {
    case 'CheckBox':
    case 'Switch':
      return button('checkbox');
    case 'RadioButton':
      return button('radio');
    case 'TextInput':
    case 'MultilineTextInput':
    case 'SearchInput': {
      const element = input('text');
      element.addEventListener('change', () => sea.act(item.id, 'type', 0, element.value));
      return element;
    }
    case 'Window':
    case 'TitleBar':
    case 'Image':
    case 'ScrollView':
    case 'ScrollBar':
    case 'ProgressIndicator':
      return document.createElement('p');
    default:
      return button();
  }
}

function attribute(element, name, value) {
  if (value === undefined || value === null) element.removeAttribute(name);
  else if (element.getAttribute(name) !== String(value)) element.setAttribute(name, String(value));
}

function follow(element, item) {
  const name = [item.label, item.value].filter(Boolean).join(': ');
  if (element instanceof HTMLInputElement) {
    attribute(element, 'aria-label', item.label || 'value');
    if (item.now !== undefined) {
      attribute(element, 'min', item.least);
      attribute(element, 'max', item.greatest);
      attribute(element, 'step', item.step ?? 'any');
      attribute(element, 'aria-valuetext', item.value || undefined);
    }
    const value = item.now === undefined ? item.value : String(item.now);
    // What is being typed stays until it is done.
    if (document.activeElement !== element || element.type === 'range') {
      if (element.value !== value) element.value = value;
    }
  } else if (element.textContent !== name) {
    element.textContent = name;
  }
  attribute(element, 'aria-expanded', item.open);
  attribute(element, 'aria-checked', element.hasAttribute('role') ? Boolean(item.on) : undefined);
  attribute(element, 'aria-pressed', element.hasAttribute('role') ? undefined : item.on);
  attribute(element, 'aria-disabled', item.disabled || undefined);
}

// Keeps the elements in step with the widgets, in reading order.
export function mirror(sea, list, told) {
  const elements = new Map();
  return () => {
    const items = new Map();
    for (const item of sea.described()) {
      const key = `${item.id} ${item.role} ${item.now === undefined}`;
      if (!items.has(key)) items.set(key, item);
    }
    // First what has gone, so that what stays need not move: an element that is moved loses the keyboard.
    for (const [key, element] of elements) {
      if (items.has(key)) continue;
      element.remove();
      elements.delete(key);
    }
    let at = list.firstElementChild;
    for (const [key, item] of items) {
      if (!elements.has(key)) elements.set(key, mirrorOf(item, sea));
      const element = elements.get(key);
      follow(element, item);
      if (element === at) at = at.nextElementSibling;
      else list.insertBefore(element, at);
    }
    const now = sea.told();
    if (told.textContent !== now) told.textContent = now;
  };
}

if (typeof document !== 'undefined') {
  const ask = document.getElementById('readers-ask');
  ask?.addEventListener('click', () => {
    if (!window.seastate) return;
    const section = document.getElementById('readers');
    section.hidden = false;
    ask.hidden = true;
    section.focus();
    const step = mirror(window.seastate, document.getElementById('controls'), document.getElementById('told'));
    step();
    setInterval(step, EVERY_MS);
  });
}

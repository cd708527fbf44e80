// The panel for screen readers, which see the canvas as one picture. On request, every widget gets an HTML element.
// The program describes its widgets (src/app/screen_readers.rs) and receives the actions on their elements.

const EVERY_MS = 200; // interval at which the elements follow the widgets

const TEXTS = new Set(['Label', 'Heading', 'Paragraph']); // AccessKit roles of plain text

// Creates the element for a widget; its events go to the program.
function mirrorOf(item, sea) {
  const button = (role) => {
    const element = document.createElement('button');
    element.type = 'button';
    if (role) element.setAttribute('role', role);
    element.addEventListener('click', () => sea.perform_widget_action(item.id, 'click', 0, ''));
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
    // Arrow keys take the program's own steps, because the slider's scale may be logarithmic.
    element.addEventListener('keydown', (event) => {
      const way = { ArrowRight: 'more', ArrowUp: 'more', ArrowLeft: 'less', ArrowDown: 'less' }[event.key];
      if (!slider || !way) return;
      event.preventDefault();
      sea.perform_widget_action(item.id, way, 0, '');
    });
    element.addEventListener(slider ? 'input' : 'change', () => {
      const value = element.valueAsNumber;
      if (Number.isFinite(value)) sea.perform_widget_action(item.id, 'set', value, '');
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
      element.addEventListener('change', () =>
        sea.perform_widget_action(item.id, 'type', 0, element.value),
      );
      return element;
    }
    default:
      return item.clickable ? button() : document.createElement('p');
  }
}

// Sets an attribute, or removes it if the value is missing.
function attribute(element, name, value) {
  if (value === undefined || value === null) element.removeAttribute(name);
  else if (element.getAttribute(name) !== String(value)) element.setAttribute(name, String(value));
}

// Updates an element from its widget's description.
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
    // A text field keeps what the visitor is typing.
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

// Returns a function that updates the elements in `list` from the widgets, in reading order, and the text in `told`.
export function mirror(sea, list, told) {
  const elements = new Map();
  return () => {
    const items = new Map();
    for (const item of sea.accessible_items()) {
      const key = `${item.id} ${item.role} ${item.now === undefined}`;
      if (!items.has(key)) items.set(key, item);
    }
    // Removes old elements first, so that the others need not move: an element that moves loses the keyboard focus.
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
    const now = sea.announcement();
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

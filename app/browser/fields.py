"""Clicks on HTML elements that set fields of the page.

viser reports no clicks on HTML. A click on an element with the attributes of `sets` is therefore
entered into a number field, a slider or a dropdown of the page, as if typed there. The script also
restores numbers that are left empty, and removes the focus from fields after use.
"""

import viser

from app.browser.internals import (
    DROPDOWN,
    DROPDOWN_OPTION,
    NUMBER_INPUT,
    element_id,
    run_script,
)

_SCRIPT = """
if (!window.tofscopeSet) {
  const type = (input, text) => {
    Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, 'value').set.call(input, text);
    input.dispatchEvent(new Event('input', {bubbles: true}));
    input.dispatchEvent(new Event('focusout', {bubbles: true}));
  };
  const choose = (field, value, tries) => {  // options appear shortly after it is opened
    const list = document.getElementById(field.getAttribute('aria-controls'));
    const options = list ? [...list.querySelectorAll('%(option)s')] : [];
    const wanted = options.find(option => option.textContent === value);
    if (wanted) wanted.click();
    else if (tries > 0) setTimeout(() => choose(field, value, tries - 1), 30);
  };
  window.tofscopeSet = (id, value) => {
    const field = document.getElementById(id);
    if (!field) return;
    if (field.matches('%(dropdown)s')) {
      field.click();
      choose(field, value, 20);
      return;
    }
    const number = 'input:not([type=hidden])';
    type(field.matches(number) ? field : field.parentElement.querySelector(number), value);
  };
  document.addEventListener('click', event => {
    const element = event.target.closest('[data-sets]');
    if (!element) return;
    window.tofscopeSet(element.dataset.sets, element.dataset.value);
  });
  // A focused field would swallow the keys of playback.
  const leave = () => setTimeout(() => document.activeElement?.blur(), 0);
  document.addEventListener('click', event => {
    if (event.target.closest('%(option)s')) leave();
  });
  document.addEventListener('keydown', event => {
    if (event.key === 'Enter' && event.target.matches('input')) leave();
  });
  const number = target => target.matches('%(number)s');
  document.addEventListener('focusin', ({target}) => {
    if (number(target)) target.dataset.before = target.value;
  });
  document.addEventListener('focusout', ({target}) => {
    if (number(target) && target.value === '') type(target, target.dataset.before);
  });
}
"""
_NAMES = {
    "dropdown": DROPDOWN,
    "number": NUMBER_INPUT,
    "option": DROPDOWN_OPTION,
}


def set_up_fields(client: viser.ClientHandle) -> None:
    """Install the script that lets clicks set fields."""
    run_script(client, _SCRIPT % _NAMES)


def sets(control: viser.GuiInputHandle, value: str) -> str:
    """HTML attributes of an element whose click sets a control to a value.

    Args:
        control: a dropdown that has this option, or a number field.
        value: as the control shows it; without quotes.
    """
    return f'data-sets="{element_id(control)}" data-value="{value}"'

// One table of what a person can do, behind buttons, keys and the list of keys.

export interface Action {
  about: string;
  /** As KeyboardEvent.key has it. */
  key?: string;
  /** Whether the key works in a text field, too. */
  always?: boolean;
  run(): void;
  /** When the key is let go. */
  end?(): void;
}

/** Let the keys of a table work on the whole page; while they are off, only those that always do. */
export function bindKeys(actions: readonly Action[], areOn: () => boolean): void {
  let held: Action | null = null;
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
    const isField = event.target instanceof HTMLInputElement || event.target instanceof HTMLSelectElement;
    const isTyping = isField || !areOn();
    const action = actions.find((one) => one.key === event.key && (one.always || !isTyping));
    if (action === undefined) return;
    event.preventDefault();
    action.run();
    if (action.end) held = action;
  });
  const end = () => {
    held?.end?.();
    held = null;
  };
  document.addEventListener("keyup", (event) => {
    if (event.key === held?.key) end();
  });
  window.addEventListener("blur", end);
}

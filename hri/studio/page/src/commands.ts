// One table of what a person can do, behind buttons, keys and the list of keys.

export interface Action {
  about: string;
  /** As KeyboardEvent.key has it. */
  key?: string;
  /** Whether the key works in a text field, too. */
  always?: boolean;
  run(): void;
}

/** Let the keys of a table work on the whole page; while they are off, only those that always do. */
export function bindKeys(actions: readonly Action[], areOn: () => boolean): void {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
    const isTyping = event.target instanceof HTMLInputElement || !areOn();
    const action = actions.find((one) => one.key === event.key && (one.always || !isTyping));
    if (action === undefined) return;
    event.preventDefault();
    action.run();
  });
}

// Dialogs that leave Stop within reach. A modal one (`showModal`) would take the whole page out of
// reach, so these are not: what is not theirs is made inert by hand, all but Stop and what belongs to
// it.

const IN_REACH = "#stop, #release, #notice";

const shown: HTMLDialogElement[] = [];
let silent = new Set<HTMLElement>();

/** Show a dialog, and let the focus stay in it; what closes it, and gives the focus back. */
export function show(dialog: HTMLDialogElement): () => void {
  const before = document.activeElement;
  const hide = (): void => {
    const place = shown.indexOf(dialog);
    if (place < 0) return;
    shown.splice(place, 1);
    const hadFocus = dialog.contains(document.activeElement);
    dialog.close();
    settle();
    if (hadFocus && before instanceof HTMLElement) before.focus();
  };
  if (shown.includes(dialog)) return hide;
  shown.push(dialog);
  settle();
  dialog.setAttribute("closedby", "closerequest"); // a phone's gesture for "back"
  dialog.addEventListener("close", hide, { once: true });
  dialog.show();
  settle();
  return hide;
}

/** Leave only the dialog that was shown last within reach, and Stop; also after another view came. */
export function settle(): void {
  const top = [...shown].reverse().find((one) => one.checkVisibility());
  const next = new Set<HTMLElement>();
  for (let one: Element | null = top ?? null; one !== null && one !== document.body; one = one.parentElement)
    for (const other of one.parentElement?.children ?? []) if (other !== one) add(other, next);
  for (const one of silent) if (!next.has(one)) one.inert = false;
  for (const one of next) one.inert = true;
  silent = next;
}

function add(part: Element, parts: Set<HTMLElement>): void {
  if (!(part instanceof HTMLElement) || part.matches(IN_REACH)) return;
  if (part.querySelector(IN_REACH) === null) parts.add(part);
  else for (const child of part.children) add(child, parts);
}

// Which XML files are lockstep's. Others, as those of Maven, are left to other extensions.

// Roots of trees, scenarios and leaf files; a text without an element may become one.
export function isLockstep(text: string): boolean {
  const root = /<(?![?!])\s*([\w:.-]+)/.exec(withoutComments(text));
  if (root === null) return text.length < 4096;
  return ["root", "scenarios", "leaves"].includes(root[1]);
}

export function isTree(text: string): boolean {
  return /<root[\s>]/.test(withoutComments(text));
}

function withoutComments(text: string): string {
  return text.slice(0, 65536).replace(/<!--[\s\S]*?-->/g, "");
}

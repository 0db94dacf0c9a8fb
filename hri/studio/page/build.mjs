// Bundles the page into ../built, which is committed; with --test the tests into test/built.
import { build } from "esbuild";
import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";

const common = {
  bundle: true,
  format: "esm",
  jsx: "automatic",
  target: "es2022",
  logLevel: "warning",
  define: { "process.env.NODE_ENV": '"production"' },
};

/** The licenses of what is bundled, beside it. */
function licenses(inputs) {
  const names = new Set(inputs.map((path) => path.match(/^node_modules\/((?:@[^/]+\/)?[^/]+)/)?.[1]).filter(Boolean));
  return [...names].sort().map((name) => {
    const folder = `node_modules/${name}`;
    const { version, license } = JSON.parse(readFileSync(`${folder}/package.json`, "utf8"));
    const file = readdirSync(folder).find((one) => /^licen[cs]e/i.test(one));
    const text = file ? readFileSync(`${folder}/${file}`, "utf8").trim() : "";
    return `${name} ${version} (${license})\n\n${text}\n`;
  }).join(`\n${"-".repeat(80)}\n\n`);
}

if (process.argv.includes("--test")) {
  await build({
    ...common,
    entryPoints: readdirSync("test").filter((name) => name.endsWith(".test.ts")).map((name) => `test/${name}`),
    platform: "node",
    outdir: "test/built",
    outExtension: { ".js": ".mjs" },
  });
} else {
  if (existsSync("../built")) rmSync("../built", { recursive: true });
  mkdirSync("../built");
  // What only some views need is a bundle of its own, loaded when the view is opened first.
  const { metafile } = await build({
    ...common,
    entryPoints: ["src/studio.ts"],
    splitting: true,
    chunkNames: "[name]-[hash]",
    minify: true,
    metafile: true,
    outdir: "../built",
  });
  for (const name of ["studio", "composer"])
    await build({ ...common, entryPoints: [`src/${name}.css`], minify: true, outfile: `../built/${name}.css` });
  writeFileSync("../built/licenses.txt", licenses(Object.keys(metafile.inputs)));
  for (const name of ["index.html", "icon.svg"]) copyFileSync(`src/${name}`, `../built/${name}`);
}

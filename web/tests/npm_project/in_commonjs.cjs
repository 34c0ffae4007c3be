async function main() {
  const { load } = await import("beeline-arms");
  const { compute } = await import("./compute.js");
  console.log(JSON.stringify(await compute(load)));
}
main();

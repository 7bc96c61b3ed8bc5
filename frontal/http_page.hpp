#pragma once

namespace graycube {

/// The farm at a glance; asks /api once a second. Everything shown goes through textContent, so
/// that a scene's name can't be markup. With the farm's token behind the address's '#', which
/// browsers send nowhere by themselves, jobs can be cancelled.
inline constexpr const char* kHttpPage = R"page(<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Graycube</title>
<style>
  body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 62rem; padding: 0 1rem;
         color: #222; background: #f6f5f2; }
  h1 { font-size: 1.5rem; margin: 0 0 1rem; }
  h2 { font-size: 1.1rem; margin: 2rem 0 .5rem; }
  table { border-collapse: collapse; width: 100%; background: #fff; }
  th, td { text-align: left; padding: .4rem .7rem; border-bottom: 1px solid #ddd;
           vertical-align: top; }
  th { font-weight: 600; background: #eceae4; }
  progress { width: 8rem; }
  img { max-width: 12rem; max-height: 9rem; display: block; }
  .failed { color: #a40000; }
  #note { color: #a40000; min-height: 1.5em; }
</style>
<h1>Graycube</h1>
<div id="note" role="status"></div>
<h2>Jobs</h2>
<table><thead><tr><th>Job<th>Scene<th>State<th>Progress<th>Checks whether all is done
<th>Picture</tr></thead>
<tbody id="jobs"></tbody></table>
<h2>Nodes</h2>
<table><thead><tr><th>Rank<th>Label<th>Process<th>State<th>Threads</tr></thead>
<tbody id="nodes"></tbody></table>
<script>
const token = new URLSearchParams(location.hash.slice(1)).get("token");
const pictures = new Map();
function cell(row, text, name) {
  const td = row.insertCell();
  td.textContent = text;
  if (name) td.className = name;
  return td;
}
function cancelButton(job) {
  const button = document.createElement("button");
  button.textContent = "cancel";
  button.setAttribute("aria-label", "cancel job " + job.job);
  button.addEventListener("click", async () => {
    button.disabled = true;
    const answer = await fetch("/api/jobs/" + job.job + "/cancel",
                               {method: "POST", headers: {Authorization: "Bearer " + token}});
    if (!answer.ok) document.getElementById("note").textContent =
        "Job " + job.job + " can't be cancelled (" + answer.status + ").";
  });
  return button;
}
function showJob(body, job) {
  const row = body.insertRow();
  cell(row, job.job);
  cell(row, job.scene);
  cell(row, job.message ? job.state + ": " + job.message : job.state,
       job.state === "failed" ? "failed" : "");
  const bar = document.createElement("progress");
  bar.value = job.state === "done" ? 1 : job.fraction;
  bar.setAttribute("aria-label", "progress of job " + job.job);
  const progress = cell(row, "");
  progress.append(bar, " " + job.tiles_whole + " of " + job.tiles + " parts are final");
  cell(row, job.rounds);
  const picture = cell(row, "");
  const hasEnded = ["done", "failed", "cancelled"].includes(job.state);
  if (token && !hasEnded) picture.append(cancelButton(job));
  if (job.state !== "done") return;
  if (!pictures.has(job.job)) {
    const image = new Image();
    image.src = "/jobs/" + job.job + ".png";
    image.alt = "picture of job " + job.job;
    image.loading = "lazy";
    pictures.set(job.job, image);
  }
  picture.append(pictures.get(job.job));
}
function showNode(body, node) {
  const row = body.insertRow();
  for (const text of [node.rank, node.gray, node.pid, node.state, node.threads]) cell(row, text);
}
async function ask(path) {
  const answer = await fetch(path);
  if (!answer.ok) throw new Error(path + ": " + answer.status);
  return answer.json();
}
async function refresh() {
  const note = document.getElementById("note");
  try {
    const [jobs, nodes] = await Promise.all([ask("/api/jobs"), ask("/api/nodes")]);
    const jobRows = document.createElement("tbody");
    jobs.jobs.slice().reverse().forEach(job => showJob(jobRows, job));
    document.getElementById("jobs").replaceChildren(...jobRows.rows);
    const nodeRows = document.createElement("tbody");
    nodes.nodes.forEach(node => showNode(nodeRows, node));
    document.getElementById("nodes").replaceChildren(...nodeRows.rows);
    note.textContent = "";
  } catch (error) {
    note.textContent = "The farm does not answer (" + error.message + ").";
  }
  setTimeout(refresh, 1000);
}
refresh();
</script>
)page";

}  // namespace graycube

#include "apps/batch/task_record.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "libindet/base/error.h"
#include "libindet/io/whole_file.h"

namespace indet {

std::filesystem::path tasks_folder(const std::filesystem::path& folder) { return folder / "tasks"; }

void write_task_record(const std::filesystem::path& path, const TaskRecord& record) {
  nlohmann::json done = nlohmann::json::array(), failures = nlohmann::json::array(),
                 in_hand = nlohmann::json::array();
  for (const TaskRecord::DoneItem& item : record.done)
    done.push_back({{"name", item.name}, {"seconds", item.seconds}});
  for (const ItemFailure& failure : record.failures)
    failures.push_back({{"item", failure.item}, {"reason", failure.reason}});
  for (const TaskRecord::ItemInHand& item : record.in_hand)
    in_hand.push_back({{"name", item.name}, {"since", item.since}});
  const nlohmann::json document = {{"work", record.work},
                                   {"shard", record.shard},
                                   {"host", record.host},
                                   {"process", record.process},
                                   {"job", record.job},
                                   {"started", record.started},
                                   {"updated", record.updated},
                                   {"threads", record.threads},
                                   {"state", record.state},
                                   {"got_further", record.got_further},
                                   {"there_already", record.there_already},
                                   {"done", done},
                                   {"failures", failures},
                                   {"in_hand", in_hand}};
  // A failure may quote what is not UTF-8.
  write_note(path, document.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

TaskRecord read_task_record(const std::filesystem::path& path) {
  try {
    std::ifstream file(path);
    const nlohmann::json document = nlohmann::json::parse(file);
    TaskRecord record;
    document.at("work").get_to(record.work);
    document.at("shard").get_to(record.shard);
    document.at("host").get_to(record.host);
    document.at("process").get_to(record.process);
    document.at("job").get_to(record.job);
    document.at("started").get_to(record.started);
    document.at("updated").get_to(record.updated);
    document.at("threads").get_to(record.threads);
    document.at("state").get_to(record.state);
    document.at("got_further").get_to(record.got_further);
    document.at("there_already").get_to(record.there_already);
    for (const nlohmann::json& item : document.at("done"))
      record.done.push_back({item.at("name"), item.at("seconds").get<std::map<std::string, double>>()});
    for (const nlohmann::json& failure : document.at("failures"))
      record.failures.push_back({failure.at("item"), failure.at("reason")});
    for (const nlohmann::json& item : document.at("in_hand"))
      record.in_hand.push_back({item.at("name"), item.at("since")});
    return record;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: is not the record of a task ({})", path.string(), error.what()));
  }
}

}  // namespace indet

#include "tools/strata/explain/explain_candidate.h"

#include "tools/oracle/fragments/form.h"
#include "tools/oracle/search/edits.h"
#include "tools/strata/compare/compare_scene.h"
#include "tools/strata/table.h"

namespace strata::tools {

int explain_candidate(CandidateQuestion question) {
    const oracle::Picture picture = oracle::read_picture(question.candidate);
    const oracle::TargetImage& colors = colors_of(picture);
    if (question.x >= colors.width || question.y >= colors.height)
        throw CLI::ValidationError("--pixel", "expected a pixel from 0,0 to " + std::to_string(colors.width - 1) + "," +
                                                  std::to_string(colors.height - 1) + ", found " +
                                                  std::to_string(question.x) + "," + std::to_string(question.y));
    SceneQuestion scene{.run = std::move(question.run), .algorithm = "", .json = question.json};
    const Session session = open_at_size(scene, colors, question.candidate);
    oracle::verdict::SceneFragments fragments{{session.scene.list, session.view, session.profile, scene.run.render},
                                              scene.run.render.fragment_memory};
    const oracle::verdict::Formed formed = oracle::verdict::formed(fragments, colors, false);
    const oracle::verdict::Colors seen = formed.colors();
    const oracle::verdict::Verdict verdict = judge(fragments, seen);
    const oracle::verdict::PixelEdits edits = edits_at(fragments, seen, verdict, question.x, question.y);
    print(question.json ? to_json(edits, verdict, session.scene.list) : to_text(edits, verdict, session.scene.list));
    return edits.is_right ? 0 : 1;
}

}  // namespace strata::tools
